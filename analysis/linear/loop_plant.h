#pragma once
/// What a position controller of a levitated rig has before it, exactly linearised from tick to
/// tick of the position loop (t_k = k Ts): rotor, magnets, bridges, current loops and delays. The
/// one linear loop of this project: analyses close it (analysis/closed_loop.h), syntheses design
/// for it (control_plant.h).
///
///   x = [plant | integrals of the current loops | their feedback | forces under way]
///   x_(k+1) = A x_k + B f_k + E d_k
///
///   t_k            readings; the forces f_k that follow from them are on their way
///   every period   duty from set-point and last period's mean current; plant (period_map.h)
///   t_(k+1)        those forces become set-points, `loop-delay` later at the current loops
///
/// f [N]: forces asked for, per axis; d: generalised forces on the kept coordinates, constant over
/// the tick. A disturbance that is not held but continuous: `Disturbance`.
#include <Eigen/Dense>

#include "analysis/linear/period_map.h"

namespace ambrig {

/// What acts on the plant continuously as Re(. e^{iωt}).
struct HarmonicInput {
  double omega = 0;         // [rad/s]
  Eigen::VectorXcd pushed;  // (m) generalised forces on the kept coordinates
};

class LoopPlant {
 public:
  LoopPlant(const OperatingPoint& point, LinearPlant plant);

  double Ts() const { return Ts_; }
  const LinearPlant& plant() const { return plant_; }
  Eigen::Index states() const { return A.rows(); }
  Eigen::Index axes() const { return plant_.axes(); }
  /// Readings, shaft at the magnets, forces of the magnets: rows of the plant over x.
  Eigen::MatrixXd Rows(const Eigen::MatrixXd& of_plant) const;
  /// What a continuous harmonic disturbance adds to x over one tick: x e^{iωTs} = A x + this.
  Eigen::VectorXcd Disturbance(const HarmonicInput& input) const;

  /// Where the parts of x begin; every current has one integral and one feedback.
  Eigen::Index integral() const { return plant_.n(); }
  Eigen::Index feedback() const {
    return integral() + static_cast<Eigen::Index>(plant_.coils.size());
  }
  Eigen::Index force() const { return feedback() + static_cast<Eigen::Index>(plant_.coils.size()); }

  Eigen::MatrixXd A, B, E;  // (N x N), (N x axes), (N x m)

 private:
  template <class Matrix, class Disturb>
  void Tick(Matrix& x, const Matrix& force, Disturb&& disturb) const;

  LinearPlant plant_;
  PeriodMap period_;
  Eigen::MatrixXd set_points_;  // (currents x axes) [A/N]
  double Ts_ = 0, kp_ = 0, ki_T_ = 0, duty_per_volt_ = 0, fed_back_ = 1;
  int M_ = 1, late_ = 0;  // periods of the controller; of the loop's delay
};

}  // namespace ambrig
