#pragma once
/// First derivatives of one bearing's magnetic circuit at an operating point, exact (the circuit's
/// own equations differentiated; no differences):
///
///   δi = I_λ δλ + I_r δr + I_z δz   currents of the coils that carry    [A]
///   δf = F_λ δλ + F_r δr + F_z δz   force on the rotor                  [N]
///   δz' = Z_λ δλ + Z_r δr + Z_z δz  fluxes that iron remembers          [Wb]
///
/// The s states z are there where laws of the iron take time (eddy currents: every pole has one per
/// relaxation, actuators/magnetics/flux_law.h); laws without a linear form (hysteresis) are left
/// out. At rest z' = 0, and at constant current, what a bearing's data sheet calls k_i and k_s:
///   δf = F_λ I_λ⁻¹ δi + (F_r - F_λ I_λ⁻¹ I_r) δr
///
/// r is the shaft centre at the bearing plane in stator axes (x, y) [m]; of a thrust bearing z, of
/// an opposed pair its own axis, along x. Source: docs/theory/base_model.md section 2.
#include <Eigen/Dense>
#include <vector>

#include "actuators/magnetics/stator_lanes.h"

namespace ambrig {

struct LinearBearing {
  std::vector<int> coils;              // lanes of the n coils that carry current
  Eigen::VectorXd current;             // (n) at the operating point [A]
  Eigen::VectorXd resistance;          // (n) [ohm]
  Eigen::MatrixXd I_lambda;            // (n x n) [1/H]
  Eigen::MatrixXd I_r;                 // (n x 2) at constant linkage [A/m]
  Eigen::MatrixXd F_lambda;            // (2 x n) [N/Wb]
  Eigen::Matrix2d F_r;                 // at constant linkage [N/m]
  Eigen::MatrixXd I_z, F_z;            // (n x s) [A/Wb], (2 x s) [N/Wb]
  Eigen::MatrixXd Z_lambda, Z_r, Z_z;  // (s x n) [1/s], (s x 2) [Wb/(s m)], (s x s) [1/s]

  Eigen::Index states() const { return Z_z.rows(); }
  /// Without states: what slow changes see.
  LinearBearing AtRest() const;
  // At rest:
  Eigen::MatrixXd Inductance() const;      // (n x n) [H]
  Eigen::MatrixXd ForceOfCurrent() const;  // (2 x n) k_i per coil [N/A]
  /// df/dr at constant current [N/m]; positive pulls away from the centre.
  Eigen::Matrix2d NegativeStiffness() const;
};

/// At these coil currents [A] with the shaft at (x, y); the laws of the iron settle there. Coils
/// told 0 A are blocked by their diodes when the bridges have two quadrants.
LinearBearing LineariseBearing(const StatorLanes& lanes, const Lane& current, double x, double y);

/// The same bearing, at rest, when its coils carry only p given patterns of current, i = P v, and v
/// takes the place of the coils' currents. Linkages count along the patterns, P⁺ λ, with
/// P⁺ = (PᵀP)⁻¹Pᵀ:
///
///   P⁺ λ = (P⁺ L P) v - P⁺ L I_r r,   L = I_λ⁻¹
///
/// The patterns of the axes leave out what the other patterns of the coils (bias) do in between;
/// exact at constant current. `pattern`: n x p, rows in the order of `coils`.
LinearBearing OntoPatterns(const LinearBearing& bearing, const Eigen::MatrixXd& pattern);
/// P⁺ [p x n].
Eigen::MatrixXd PatternInverse(const Eigen::MatrixXd& pattern);

}  // namespace ambrig
