#pragma once
/// Modes of the whole beam (rotor/shaft/whole_beam_modes.h) at one speed after the other. From
/// speed to speed only the supports' coefficients change, so that the reduced rotor is updated by
/// what they change; which poles there are comes from the reduced rotor at every speed, by its
/// eigenvalues alone; each mode starts from the pole found there and from the shape of its
/// neighbour at the speed before. Where an iteration leaves its pole, or two end as one, the speed
/// is solved without the one before (FindWhirlModes).
#include "rotor/shaft/whole_beam_modes.h"

namespace ambrig {

class WhirlSweep {
 public:
  /// `shapes` as FindWhirlModes; the beam and they must outlive the sweep.
  WhirlSweep(const BeamRotor& beam, const Eigen::MatrixXd& shapes, int count)
      : beam_(beam), shapes_(shapes), count_(count) {}

  /// As FindWhirlModes.
  WholeBeamModes At(double speed);

 private:
  void Reduce();
  /// The poles, each with the shape of the nearest mode within a tenth at the speed before, or with
  /// its own of the reduced rotor; false where one is a rigid motion that rounding turns.
  bool StartFrom(const std::vector<std::complex<double>>& poles, double speed,
                 std::vector<WhirlMode>& out) const;
  bool FromNeighbour(double speed, WholeBeamModes& out) const;

  const BeamRotor& beam_;
  const Eigen::MatrixXd& shapes_;
  int count_;
  LinearRotor rotor_, reduced_;  // at the last speed
  LinearRotor first_, first_reduced_;
  std::vector<WhirlMode> before_;
};

}  // namespace ambrig
