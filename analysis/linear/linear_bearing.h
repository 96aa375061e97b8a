#pragma once
/// First derivatives of one bearing's magnetic circuit at an operating point, exact (the circuit's
/// own rate equations, actuators/magnetics/coil_network.h, give them; no differences):
///
///   δi = I_λ δλ + I_r δr            currents of the coils that carry    [A]
///   δf = F_λ δλ + F_r δr            force on the rotor                  [N]
///
/// and from them at constant current, what a bearing's data sheet calls k_i and k_s:
///   δf = F_λ I_λ⁻¹ δi + (F_r - F_λ I_λ⁻¹ I_r) δr
///
/// r is the shaft centre at the bearing plane in stator axes (x, y) [m]; of a thrust bearing z, of
/// an opposed pair its own axis, along x. Source: docs/theory/base_model.md section 2.
#include <Eigen/Dense>
#include <vector>

#include "actuators/magnetics/stator_lanes.h"

namespace ambrig {

struct LinearBearing {
  std::vector<int> coils;      // lanes of the n coils that carry current
  Eigen::VectorXd current;     // (n) at the operating point [A]
  Eigen::VectorXd resistance;  // (n) [ohm]
  Eigen::MatrixXd I_lambda;    // (n x n) [1/H]
  Eigen::MatrixXd I_r;         // (n x 2) at constant linkage [A/m]
  Eigen::MatrixXd F_lambda;    // (2 x n) [N/Wb]
  Eigen::Matrix2d F_r;         // at constant linkage [N/m]

  Eigen::MatrixXd Inductance() const;      // (n x n) [H]
  Eigen::MatrixXd ForceOfCurrent() const;  // (2 x n) k_i per coil [N/A]
  /// df/dr at constant current [N/m]; positive pulls away from the centre.
  Eigen::Matrix2d NegativeStiffness() const;
};

/// At these coil currents [A] with the shaft at (x, y). Coils told 0 A are blocked by their diodes
/// when the bridges have two quadrants.
LinearBearing LineariseBearing(const StatorLanes& lanes, const Lane& current, double x, double y);

/// The same bearing when its coils carry only p given patterns of current, i = P v, and v takes the
/// place of the coils' currents. Linkages count along the patterns, P⁺ λ, with P⁺ = (PᵀP)⁻¹Pᵀ:
///
///   P⁺ λ = (P⁺ L P) v - P⁺ L I_r r,   L = I_λ⁻¹
///
/// The patterns of the axes leave out what the other patterns of the coils (bias) do in between;
/// exact at constant current. `pattern`: n x p, rows in the order of `coils`.
LinearBearing OntoPatterns(const LinearBearing& bearing, const Eigen::MatrixXd& pattern);
/// P⁺ [p x n].
Eigen::MatrixXd PatternInverse(const Eigen::MatrixXd& pattern);

}  // namespace ambrig
