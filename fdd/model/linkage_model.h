#pragma once
/// Nominal magnetic circuit of one bearing as the controller knows it: linkages of all coils from
/// measured currents and position, one lane per coil.
///
///   P_j = 1/(reluctance of gap g_j): actuators/magnetics/stator_geometry.h           [H]
///   radial   λ_j = n_j P_j (n_j i_j - U) + L_l i_j,  U = Σ P n i / Σ P               [Wb]
///   thrust   λ_j = n_j P_j (n_j i_j + n_o i_o) + L_l i_j, o the other winding of the side
///   opposed  λ_j = n_j P_j n_j i_j + L_l i_j
///
/// n_j: signed turns. Source: docs/theory/base_model.md section 2.
#include "actuators/magnetics/stator_geometry.h"

namespace ambrig {

/// Parts of the nominal gap: no gap is taken for smaller than the first; below the second the error
/// of a sensed position rules the inductance, and currents are not compared with the model.
inline constexpr double kLeastGap = 0.05, kClosestGap = 0.4;

/// Permeances of all poles while the shaft moves. [H]
struct MovingPermeance {
  Lane start, end, middle, change;
  double total = 0, largest = 0;  // Σ of the middle, and its largest
};

struct LinkageModel : StatorGeometry {
  /// Permeances at (x, y) [H]; zero in lanes without a coil.
  Lane Permeance(double x, double y) const;
  /// The same from one place (x, y) to another, in one go.
  void Permeance(const double* from, const double* to, MovingPermeance* out) const;
  /// Own inductance of coil j for permeances P with sum `total` [H].
  double SelfInductance(int j, const Lane& P, double total) const;
  /// The same with the rotor at (x, y) [H].
  double SelfInductanceAt(int j, double x, double y) const;
};

/// Of a radial, a thrust or an opposed stator, nominal values.
template <class Stator>
LinkageModel MakeLinkageModel(const Stator& stator) {
  return {GeometryOf(stator)};
}

}  // namespace ambrig
