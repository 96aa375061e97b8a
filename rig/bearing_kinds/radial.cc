/// Eight poles round the shaft, a floating rotor between them; two axes.
#include <fmt/format.h>

#include <cmath>

#include "rig/bearing_kinds/bearing_kind.h"

namespace ambrig {

namespace {

void ReadRadial(const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
  const long long poles = t.Integer("poles", kPoles);
  if (poles != kPoles) t.Fail("poles", fmt::format("= {}, allowed: 8", poles));
  std::string& winding = b.radial.winding;
  winding = t.String("winding", winding);
  if (winding.size() != kPoles || winding.find_first_not_of("NS") != std::string::npos)
    t.Fail("winding",
           fmt::format("= \"{}\", allowed: eight letters N or S, e.g. NSNSNSNS", winding));
  t.Read(b.radial, kRadialStatorFields, tolerances);
}

std::array<double, 2> CoilDirection(const BearingParameters& b, int j) {
  const RadialStator stator(b.radial);
  return {stator.cosine()[j], stator.sine()[j]};
}

void FillRadialLanes(const BearingParameters& b, StatorLanes& lanes) {
  const RadialStator stator(b.radial);
  lanes.coupling = Coupling::kFloatingRotor;
  lanes.coils = kPoles;
  lanes.reluctance.per_metre = 1 / (kMu0 * b.radial.pole_area);
  lanes.reluctance.gap0 = b.radial.gap;
  for (int j = 0; j < kPoles; ++j) {
    lanes.n[j] = stator.sense()[j] * b.radial.turns;
    lanes.leakage[j] = b.radial.leakage_inductance;
    lanes.resistance[j] = b.radial.resistance;
    lanes.direction_x[j] = stator.cosine()[j];
    lanes.direction_y[j] = stator.sine()[j];
    lanes.gap_offset[j] = b.radial.gap;
  }
}

}  // namespace

const BearingKindTable& RadialBearing() {
  static constexpr BearingKindTable table{
      .kind = BearingKind::kRadial,
      .name = "radial",
      .acts_on = kOnRadial,
      .axial = false,
      .axes =
          [](const BearingParameters& b) {
            return std::vector<std::string>{b.name + ".x", b.name + ".y"};
          },
      .read = ReadRadial,
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.A] kind = \"radial\"", kRadialStatorFields);
          },
      .gap = [](const BearingParameters& b) { return b.radial.gap; },
      .coil_resistance = [](const BearingParameters& b) { return b.radial.resistance; },
      .force_constant =
          [](const BearingParameters& b) { return RadialStator(b.radial).ForceConstant(); },
      .own_bias = [](const BearingParameters&) { return kRequired; },
      .coil_direction = CoilDirection,
      .weight = nullptr,
      .fill_lanes = FillRadialLanes,
      .plane = [](const BearingParameters&, const RotorModel& rotor,
                  double z) { return rotor.MakePlane(z); },
      .add_auxiliary =
          [](const BearingParameters& b, RotorModel& rotor) {
            rotor.AddAuxiliary(b.name, std::isnan(b.auxiliary_z) ? b.z : b.auxiliary_z,
                               *b.auxiliary);
          },
  };
  return table;
}

}  // namespace ambrig
