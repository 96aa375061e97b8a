/// Two windings on each side of a thrust disk; one axis along the shaft.
#include "rig/bearing_kinds/bearing_kind.h"

namespace ambrig {

namespace {

double ThrustForceConstant(const BearingParameters& b) {
  return 4 * kMu0 * b.thrust.turns * b.thrust.turns * b.thrust.pole_area /
         (b.thrust.gap * b.thrust.gap);
}

void FillThrustLanes(const BearingParameters& b, StatorLanes& lanes) {
  lanes.coupling = Coupling::kSides;
  lanes.coils = kThrustCoils;
  lanes.reluctance.per_metre = 2 / (kMu0 * b.thrust.pole_area);
  lanes.reluctance.gap0 = b.thrust.gap;
  for (int j = 0; j < kThrustCoils; ++j) {
    lanes.n[j] = b.thrust.turns;
    lanes.leakage[j] = b.thrust.leakage_inductance;
    lanes.resistance[j] = b.thrust.resistance;
    lanes.direction_x[j] = j < 2 ? 1 : -1;  // along z
    lanes.gap_offset[j] = b.thrust.gap;
  }
}

PlaneMap ThrustPlane(const BearingParameters&, const RotorModel&, double z) {
  PlaneMap map;
  map.z = z;
  map.Add(2, 1, 0);
  return map;
}

}  // namespace

const BearingKindTable& ThrustBearing() {
  static constexpr BearingKindTable table{
      .kind = BearingKind::kThrust,
      .name = "thrust",
      .acts_on = kOnThrust,
      .axial = true,
      .axes = [](const BearingParameters&) { return std::vector<std::string>{"z"}; },
      .read =
          [](const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
            t.Read(b.thrust, kThrustStatorFields, tolerances);
          },
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.Z] kind = \"thrust\"", kThrustStatorFields);
          },
      .gap = [](const BearingParameters& b) { return b.thrust.gap; },
      .coil_resistance = [](const BearingParameters& b) { return b.thrust.resistance; },
      .force_constant = ThrustForceConstant,
      .own_bias = [](const BearingParameters& b) { return b.thrust.bias_current; },
      .coil_direction =
          [](const BearingParameters&, int j) {
            return std::array<double, 2>{j < 2 ? 1.0 : -1.0, 0};
          },
      .weight = [](const BearingParameters&, double mass,
                   const std::array<double, 3>& gravity) { return -mass * gravity[2]; },
      .fill_lanes = FillThrustLanes,
      .plane = ThrustPlane,
      .add_auxiliary = [](const BearingParameters& b,
                          RotorModel& rotor) { rotor.SetAxialStop(*b.auxiliary); },
  };
  return table;
}

}  // namespace ambrig
