#pragma once
/// The exact linearisation of a levitated rig under its sampled controller, from tick to tick of
/// the position loop (t_k = k Ts), delays and current loops included:
///
///   x = [plant | integrals of the current loops | their feedback | controller | forces under way]
///   x_(k+1) = Phi x_k + Gamma u_k,   y_k = C x_k + D u_k
///
///   t_k            readings; controller; its forces are on their way (base_model.md section 4)
///   every period   duty from set-point and last period's mean current; plant (period_map.h)
///   t_(k+1)        those forces become set-points, `loop-delay` later at the current loops
///
/// Inputs per axis: reference [m], force excitation [N], error of the sensor [m]. Outputs per axis:
/// reading [m], force command after the injection point [N], shaft at the magnets [m], force of the
/// magnets [N]; then every coil's current [A]. A disturbance is not held but continuous, exactly:
/// `Harmonic`.
#include <Eigen/Dense>
#include <complex>
#include <string>
#include <vector>

#include "analysis/linear_controller.h"
#include "analysis/period_map.h"

namespace ambrig {

/// What acts on the plant continuously as Re(. e^{iωt}).
struct HarmonicInput {
  double omega = 0;         // [rad/s]
  Eigen::VectorXcd pushed;  // (m) generalised forces on the kept coordinates
};

class ClosedLoop {
 public:
  ClosedLoop(const OperatingPoint& point, double speed);
  ClosedLoop(const OperatingPoint& point, LinearPlant plant);

  double Ts() const { return Ts_; }
  double speed() const { return plant_.speed; }
  const LinearPlant& plant() const { return plant_; }
  Eigen::Index states() const { return Phi.rows(); }
  Eigen::Index axes() const { return plant_.axes(); }

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
  template <class Matrix>
  struct Signals;
  template <class Matrix, class Disturb>
  void Tick(Matrix& x, const Signals<Matrix>& signals, Disturb&& disturb) const;
  void FillOutputs();
  void Balance();

  LinearPlant plant_;
  PeriodMap period_;
  LinearController controller_;
  Eigen::MatrixXd set_points_;  // (coils x axes) [A/N]
  double Ts_ = 0, kp_ = 0, ki_T_ = 0, duty_per_volt_ = 0;
  int M_ = 1, late_ = 0;  // periods of the controller; of the loop's delay
  Eigen::Index at_integral_ = 0, at_feedback_ = 0, at_controller_ = 0, at_force_ = 0;
  Eigen::VectorXd scale_;
};

}  // namespace ambrig
