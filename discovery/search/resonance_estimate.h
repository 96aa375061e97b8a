#pragma once
/// A resonance that the model of a free shaft lacks, estimated from measured forces and readings
/// alone. It adds to the answer of the sensors, in the direction of whirl d = +1 (forward) or -1 at
/// the speed Omega,
///
///   y_s += H(w) Σ_b c_sb F_b,    H = 1/(w_0² - w² + d g Omega w + 2 i zeta w_0 w)
///
/// which is linear in the 2 x 2 gains c: by least squares at every frequency w_0 in turn, beside
/// errors of the forces' gains and lags, (a_sb + i w b_sb) F_b / w², and what the ends of every
/// record add, (p + i w q) H of the mode and (p + i w q) / w² of the free mass (see FreeResponse).
/// Source: Ljung, "System Identification", 2nd ed., 7.3 (prediction errors of a model that is
/// linear in its parameters).
#include <Eigen/Dense>
#include <vector>

#include "discovery/search/free_response.h"

namespace ambrig {

struct ResonanceEstimate {
  double frequency = 0, damping = 0, gyro = 0;      // [Hz], [-], [-]: w_0 = 2 pi frequency, zeta, g
  Eigen::Matrix2d gains = Eigen::Matrix2d::Zero();  // c, sensor by bearing [1/kg]
  double share = 0;  // of the weighted squared error beside the forces' own that it explains
  double forced =
      0;  // of the same, by its answer to the forces; the rest by the ends of the records
};

/// The frequencies at which a resonance explains most, best first, at most `count`; each a minimum
/// of its own.
std::vector<ResonanceEstimate> EstimateResonances(const std::vector<FreeResponse>& responses,
                                                  std::size_t count);

/// Resonances that the records of a free rotor show.
struct SeenResonances {
  bool looked = false;  // there are such records
  std::vector<ResonanceEstimate> estimates;
};
/// What the fitted records show that `h` lacks, at most three resonances.
SeenResonances LookForResonances(const CaseModel& model, const Hypothesis& h);

}  // namespace ambrig
