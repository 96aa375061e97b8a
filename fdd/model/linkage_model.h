#pragma once
/// Nominal magnetic circuit of one bearing as the controller knows it: linkages of all coils from
/// measured currents and position, one lane per coil.
///
///   P_j = 1/(reluctance of gap g_j),  g_j = gap_offset - x dx_j - y dy_j             [H]
///   radial   λ_j = n_j P_j (n_j i_j - U) + L_l i_j,  U = Σ P n i / Σ P               [Wb]
///   thrust   λ_j = n_j P_j (n_j i_j + n_o i_o) + L_l i_j, o the other winding of the side
///   opposed  λ_j = n_j P_j n_j i_j + L_l i_j
///
/// n_j: signed turns. Source: docs/theory/base_model.md section 2.
#include "actuators/magnetics/coupling.h"
#include "actuators/magnetics/gap_reluctance.h"
#include "actuators/magnetics/lane.h"
#include "actuators/magnetics/radial_stator.h"
#include "actuators/magnetics/thrust_stator.h"

namespace ambrig {

/// Permeances of all poles while the shaft moves. [H]
struct MovingPermeance {
  Lane start, end, middle, change;
  double total = 0, largest = 0;  // Σ of the middle, and its largest
};

struct LinkageModel {
  Coupling coupling = Coupling::kFloatingRotor;
  int coils = kLanes;
  Lane n, leakage, resistance;    // signed turns, [H], [ohm]
  Lane direction_x, direction_y;  // of the pull
  Lane gap_offset;                // [m]
  GapReluctance reluctance;       // [1/H]

  /// Permeances at (x, y) [H]; zero in lanes without a coil.
  Lane Permeance(double x, double y) const;
  /// The same from one place (x, y) to another, in one go.
  void Permeance(const double* from, const double* to, MovingPermeance* out) const;
  /// Own inductance of coil j for permeances P with sum `total` [H].
  double SelfInductance(int j, const Lane& P, double total) const;
};

LinkageModel MakeLinkageModel(const RadialStatorParameters& p);
LinkageModel MakeLinkageModel(const ThrustStatorParameters& p);

}  // namespace ambrig
