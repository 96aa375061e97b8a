#pragma once
/// Force of an eight-pole bearing on its rotor as a function of all coil currents, at any rotor
/// position: the reluctance network of base_model.md section 2, with the turns that failures left.
///
///   m_j = N tau_j s_j i_j, P_j = mu0 A / g_j, g_j = g0 - x cos gamma_j - y sin gamma_j
///   phi_j = P_j (m_j - sum P m / sum P),  F = sum phi_j^2 (cos gamma_j, sin gamma_j) / (2 mu0 A)
///
/// Leakage flux does not cross the gap: it adds to the inductance, not to the force.
#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

using ForceGradient = Eigen::Matrix<double, 2, 8>;

class NetworkForce {
 public:
  /// Rotor centred.
  explicit NetworkForce(const RedistributionProblem& bearing);
  /// Rotor at (x, y) [m] of the bearing plane; gaps are kept above a tenth of the nominal one.
  void MoveTo(double x, double y);

  /// [N]
  Eigen::Vector2d Force(const CoilVector& current) const;
  /// Force and dF/di [N/A]. Zero columns for coils without turns.
  Eigen::Vector2d Force(const CoilVector& current, ForceGradient* gradient) const;
  /// sum_a Q^a y_a, where F_a = i'Q^a i: contraction of the second derivative [N/A^2 of y].
  CoilVector Contract(const ForceGradient& y) const;
  /// dF/dx at fixed currents [N/m].
  Eigen::Matrix2d Stiffness(const CoilVector& current) const;

 private:
  CoilVector Flux(const CoilVector& current) const;

  double area_, gap_, x_ = 0, y_ = 0;
  CoilVector cosine_, sine_, turns_, permeance_;  // turns: N tau s
  double inverse_total_ = 0;
};

}  // namespace ambrig
