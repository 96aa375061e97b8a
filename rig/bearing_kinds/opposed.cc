/// One axis with one or two magnets facing each other, L(g) = L_inf + L_0/(1 + g/g_c).
#include <cmath>

#include "rig/bearing_kinds/bearing_kind.h"

namespace ambrig {

namespace {

double OpposedForceConstant(const BearingParameters& b) {
  // f = (1/2) (c0 + v)² L' - (1/2) (c0 - v)² L' = 2 c0 v L', one coil alone: c0 v L' about c0.
  const auto& p = b.opposed;
  const double slope =
      p.inductance_near / (p.gap_constant * std::pow(1 + p.gap / p.gap_constant, 2));
  return (p.coils > 1 ? 2 : 1) * slope;
}

void FillOpposedLanes(const BearingParameters& b, StatorLanes& lanes) {
  const OpposedStatorParameters& p = b.opposed;
  lanes.coupling = Coupling::kNone;
  lanes.coils = b.coils();
  // One "turn": N² P(g) = L_0/(1 + g/g_c).
  lanes.reluctance.per_metre = 1 / (p.gap_constant * p.inductance_near);
  lanes.reluctance.offset = 1 / p.inductance_near;
  lanes.reluctance.gap0 = p.gap;
  for (int j = 0; j < lanes.coils; ++j) {
    lanes.n[j] = 1;
    lanes.leakage[j] = p.inductance_far;
    lanes.resistance[j] = p.resistance;
    lanes.direction_x[j] = j == 0 ? 1 : -1;
    lanes.gap_offset[j] = p.gap;
  }
}

PlaneMap OpposedPlane(const BearingParameters& b, const RotorModel&, double z) {
  PlaneMap map;
  map.z = z;
  const double a = b.opposed.angle_deg * kPi / 180;
  map.Add(0, std::cos(a), 0);
  map.Add(1, std::sin(a), 0);
  return map;
}

double Weight(const BearingParameters& b, double mass, const std::array<double, 3>& gravity) {
  const double a = b.opposed.angle_deg * kPi / 180;
  return -mass * (gravity[0] * std::cos(a) + gravity[1] * std::sin(a));
}

}  // namespace

const BearingKindTable& OpposedBearing() {
  static constexpr BearingKindTable table{
      .kind = BearingKind::kOpposed,
      .name = "opposed",
      .acts_on = kOnOpposed,
      .axial = false,
      .axes = [](const BearingParameters& b) { return std::vector<std::string>{b.name + ".x"}; },
      .read =
          [](const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
            t.Read(b.opposed, kOpposedStatorFields, tolerances);
          },
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.M] kind = \"opposed\"", kOpposedStatorFields);
          },
      .gap = [](const BearingParameters& b) { return b.opposed.gap; },
      .coil_resistance = [](const BearingParameters& b) { return b.opposed.resistance; },
      .force_constant = OpposedForceConstant,
      .own_bias =
          [](const BearingParameters& b) {
            return b.opposed.bias_current > 0 ? b.opposed.bias_current : kRequired;
          },
      .coil_direction =
          [](const BearingParameters&, int j) {
            return std::array<double, 2>{j == 0 ? 1.0 : -1.0, 0};
          },
      .weight = Weight,
      .fill_lanes = FillOpposedLanes,
      .plane = OpposedPlane,
      .add_auxiliary = nullptr,
  };
  return table;
}

}  // namespace ambrig
