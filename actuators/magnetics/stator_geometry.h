#pragma once
/// The magnetic circuit of one bearing, one lane per coil: the one place where directions of pull,
/// signed turns, gaps and reluctances follow from a stator's parameters. The simulated stator
/// (stator_lanes.h), the detectors' model of it (fdd/model/linkage_model.h), redistribution and
/// drawings are all filled from here; what a true stator has otherwise, effects change in its copy.
///
///   g_j = gap_offset_j - x direction_x_j - y direction_y_j     gap of coil j               [m]
///   1/P_j = reluctance(g_j)                                    its pole's reluctance       [1/H]
///
/// x, y: the shaft's centre at the bearing, stator axes [m]; of a bearing with one axis
/// x lies along it and y is 0. Source: docs/theory/base_model.md section 2.
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "actuators/magnetics/coupling.h"
#include "actuators/magnetics/gap_reluctance.h"
#include "actuators/magnetics/lane.h"
#include "actuators/magnetics/opposed_stator.h"
#include "actuators/magnetics/pole_network.h"
#include "actuators/magnetics/radial_stator.h"
#include "actuators/magnetics/thrust_stator.h"

namespace ambrig {

/// Lanes beyond `coils` are zero.
struct StatorGeometry {
  Coupling coupling = Coupling::kFloatingRotor;
  int coils = kLanes;
  Lane n, leakage, resistance;    // signed turns, [H], [ohm]
  Lane direction_x, direction_y;  // of the pull, a unit vector: cos γ, sin γ
  Lane gap_offset;                // rotor centred [m]
  GapReluctance reluctance;       // [1/H]
  /// Of kNetwork the whole circuit. `n` is then Σ |turns| over a coil's poles, direction the
  /// way in which more current of a coil pulls, gap_offset the smallest gap, reluctance that of
  /// a mean pole.
  std::shared_ptr<const PoleNetwork> network;

  /// (x, y) of every coil's direction.
  std::vector<std::array<double, 2>> Directions() const;
  /// γ of every coil [rad], within ±π.
  std::vector<double> Angles() const;
};

StatorGeometry GeometryOf(const RadialStatorParameters& p);
StatorGeometry GeometryOf(const ThrustStatorParameters& p);
StatorGeometry GeometryOf(const OpposedStatorParameters& p);

/// The same stator pole by pole (kFloatingRotor), where each coil of its network has a pole of its
/// own, all of one area and gap, on one iron without magnets: laws of the iron act on it then, and
/// the fast path computes it. nullopt: any other.
std::optional<StatorGeometry> PoleByPole(const StatorGeometry& stator);

}  // namespace ambrig
