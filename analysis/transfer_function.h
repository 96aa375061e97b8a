#pragma once
/// Frequency responses of a closed loop between any two channels.
///
/// Inputs    A.x.reference [m], A.x.force [N] (excitations of a scenario), A.x.sensor [m] (an error
/// of
///           the reading), A.x.load [N] (a force on the rotor at the bearing's plane, continuous);
///           NAME.x.load [N] at a named plane of a beam rotor
/// Outputs   A.x [m] (reading), A.x.command [N] (force asked for, excitation included), A.x.shaft
/// [m]
///           (at the magnets), A.x.magnet [N] (force on the rotor), A.i1 [A] (coil current);
///             NAME.x [m]
///           shaft at a named plane
#include "analysis/closed_loop.h"
#include "analysis/sampled_system.h"

namespace ambrig {

class TransferFunction {
 public:
  TransferFunction(const OperatingPoint& point, const ClosedLoop& loop);

  /// Outputs x inputs of the sampled system at ω [rad/s]; named planes stand behind the loop's
  /// outputs.
  Eigen::MatrixXcd operator()(double omega) const;
  /// Of these columns of Gamma only.
  Eigen::MatrixXcd operator()(double omega, const std::vector<Eigen::Index>& columns) const;
  /// Outputs under a continuous harmonic force on the rotor.
  Eigen::VectorXcd Harmonic(const HarmonicInput& input) const;
  const Eigen::VectorXcd& eigenvalues() const { return system_.eigenvalues(); }  // z
  /// Generalised unit force on the kept coordinates along an axis at its bearing's plane; from
  /// axes() on along x, y of the named planes.
  Eigen::VectorXcd LoadOn(Eigen::Index axis) const;
  const ClosedLoop& loop() const { return loop_; }

  struct Input {
    Eigen::Index column = 0;  // of Gamma; axis of a load
    bool load = false;
    std::string unit;
  };
  struct Output {
    Eigen::Index row = 0;
    std::string unit;
  };
  /// @throws InputError for a channel that this rig does not have, naming those it has.
  Input FindInput(const std::string& channel) const;
  Output FindOutput(const std::string& channel) const;
  std::complex<double> Between(const Input& in, const Output& out, double omega) const;

 private:
  const ClosedLoop& loop_;
  std::vector<std::string> axes_, coils_, planes_;  // names: "A.x", "A.i1", "disk.x"
  Eigen::MatrixXd plane_rows_;                      // (planes x m) shaft there
  SampledSystem system_;
  Eigen::MatrixXcd D_;
};

/// From `low` to `high` Hz, `count` in equal ratios, and around every lightly damped pole closer.
std::vector<double> FrequencyGrid(const TransferFunction& transfer, double low, double high,
                                  int count);

}  // namespace ambrig
