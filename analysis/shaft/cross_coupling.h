#pragma once
/// Stability of the first forward mode against a cross-coupled stiffness that a machine's flow adds
/// (API 617 annex, API 684 level 1): force (fx, fy) = q (-y, x) at one plane, which pushes forward
/// whirl on, q from 0 up. Q_A is the expected value, Q_0 the one at which the log decrement becomes
/// zero. Level 1 is passed with Q_0/Q_A of at least 2 and a log decrement of at least 0.1 at Q_A;
/// between 2 and 10 the standard looks at the critical speed ratio and the gas density too, which
/// are left to the reader. The modified Alford equation q = 3 P rho_d / (Omega D H rho_s) of a
/// centrifugal stage: P power, D impeller diameter, H the narrowest width of its path. Clauses of
/// API RP 684 (2nd ed.), as github.com/ross-rotordynamics/ross-report (report/analysis.py) quotes
/// them beside the same formulas: SP6.8.5.6 Q_A, SP6.8.5.8 its range to 10 Q_A, SP6.8.5.9 the
/// planes, SP6.8.5.10 the screening.
#include <vector>

#include "rotor/shaft/whole_beam_modes.h"

namespace ambrig {

struct CrossCoupling {
  double z = 0;         // where it acts [m]
  double expected = 0;  // Q_A [N/m]
};

struct Level1 {
  CrossCoupling given;
  double speed = 0;                      // [rad/s]
  bool found = false;                    // a forward mode exists
  double frequency = 0;                  // of that mode [rad/s]
  std::vector<double> q, log_decrement;  // curve
  double at_expected = 0;                // log decrement at Q_A
  double limit = 0;                      // Q_0 [N/m], infinity when not reached at 1000 Q_A
  double ratio() const { return limit / given.expected; }
  bool passed() const { return found && ratio() >= 2 && at_expected >= 0.1; }
};

/// Cross-coupled stiffness of a stage by the modified Alford equation [N/m]; P [W], speed [rad/s],
/// D and H [m].
double AlfordCoupling(double power, double speed, double diameter, double width,
                      double density_ratio);

Level1 AssessCoupling(const BeamRotor& beam, double speed, int modes, const CrossCoupling& given);

}  // namespace ambrig
