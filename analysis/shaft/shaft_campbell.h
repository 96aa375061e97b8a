#pragma once
/// Damped modes of a shaft on its supports over the speed, the coefficients of the supports as they
/// are at each speed; critical speeds where a damped frequency equals the speed, to 1e-9 of it.
#include <optional>

#include "analysis/campbell.h"
#include "rotor/shaft/whole_beam_modes.h"

namespace ambrig {

struct ShaftCampbell {
  std::vector<ClosedLoopModes> rows;      // by rising speed; shapes over the dofs of Assemble
  std::vector<std::vector<double>> real;  // poles without a frequency [1/s], per row
  std::vector<ModeTrack> tracks;
  std::vector<DampedCritical> criticals;
  /// Least of -Re s over all poles of all rows: below 0 something grows.
  double least_decay = 0;
  bool stable() const { return least_decay > 0; }
};

/// Shapes that serve every speed of a beam: its modes at `speed` and at its supports.
Eigen::MatrixXd ShapesOfBeam(const BeamRotor& beam, double speed, int modes);

ShaftCampbell FollowShaft(const BeamRotor& beam, const Eigen::MatrixXd& shapes,
                          const std::vector<double>& speeds, int modes);

/// Im s(Omega) = Omega for the mode that is near `start`, by secants to 1e-9; nothing where that
/// mode is lost.
std::optional<DampedCritical> SolveCritical(const BeamRotor& beam, const Eigen::MatrixXd& shapes,
                                            int modes, const DampedCritical& start);

/// `modes` of one speed, as a row.
ClosedLoopModes RowOf(double speed, const WholeBeamModes& modes);

}  // namespace ambrig
