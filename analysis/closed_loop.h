#pragma once
/// The exact linearisation of a levitated rig under its sampled controller, from tick to tick of
/// the position loop (t_k = k Ts): the loop's plant (analysis/linear/loop_plant.h) closed by the
/// linear controller,
///
///   x = [plant, current loops, forces under way | controller]
///   x_(k+1) = Phi x_k + Gamma u_k,   y_k = C x_k + D u_k
///
/// Inputs per axis: reference [m], force excitation [N], error of the sensor [m]. Outputs per axis:
/// reading [m], force command after the injection point [N], shaft at the magnets [m], force of the
/// magnets [N]; then every coil's current [A]. A disturbance is not held but continuous, exactly:
/// `Harmonic`.
#include <Eigen/Dense>
#include <complex>
#include <string>
#include <vector>

#include "analysis/linear/loop_plant.h"
#include "analysis/linear_controller.h"

namespace ambrig {

class ClosedLoop {
 public:
  ClosedLoop(const OperatingPoint& point, double speed);
  ClosedLoop(const OperatingPoint& point, LinearPlant plant);

  double Ts() const { return open_.Ts(); }
  double speed() const { return plant().speed; }
  const LinearPlant& plant() const { return open_.plant(); }
  const LoopPlant& open() const { return open_; }
  Eigen::Index states() const { return Phi.rows(); }
  Eigen::Index axes() const { return open_.axes(); }

  // Columns of Gamma and D; rows of C and D.
  Eigen::Index Reference(Eigen::Index axis) const { return axis; }
  Eigen::Index Excitation(Eigen::Index axis) const { return axes() + axis; }
  Eigen::Index SensorError(Eigen::Index axis) const { return 2 * axes() + axis; }
  Eigen::Index Reading(Eigen::Index axis) const { return axis; }
  Eigen::Index Command(Eigen::Index axis) const { return axes() + axis; }
  Eigen::Index Position(Eigen::Index axis) const { return 2 * axes() + axis; }
  Eigen::Index Force(Eigen::Index axis) const { return 3 * axes() + axis; }
  Eigen::Index Current(Eigen::Index coil) const { return 4 * axes() + coil; }

  /// What a continuous harmonic disturbance adds to x over one tick: x e^{iωTs} = Phi x + this.
  Eigen::VectorXcd Disturbance(const HarmonicInput& input) const;
  /// Outputs at the ticks, as Re(. e^{iωt}), under that disturbance.
  Eigen::VectorXcd Harmonic(const HarmonicInput& input) const;

  /// x in sizes of its own (balance.h): the coordinates of the list above are scale() times x.
  Eigen::MatrixXd Phi, Gamma, C, D;
  const Eigen::VectorXd& scale() const { return scale_; }

 private:
  void Close();
  void FillOutputs();
  void Balance();

  LoopPlant open_;
  LinearController controller_;
  Eigen::VectorXd scale_;
};

}  // namespace ambrig
