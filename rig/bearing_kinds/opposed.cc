/// One axis with one or two magnets facing each other, L(g) = L_inf + L_0/(1 + g/g_c).
#include <cmath>

#include "effects/plant.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

double OpposedForceConstant(const BearingParameters& b) {
  // f = (1/2) (c0 + v)² L' - (1/2) (c0 - v)² L' = 2 c0 v L', one coil alone: c0 v L' about c0.
  const auto& p = b.opposed;
  const double slope =
      p.inductance_near / (p.gap_constant * std::pow(1 + p.gap / p.gap_constant, 2));
  return (p.coils > 1 ? 2 : 1) * slope;
}

std::array<double, 3> OpposedAxis(const BearingParameters& b) {
  const double a = b.opposed.angle_deg * kPi / 180;
  return {std::cos(a), std::sin(a), 0};
}

PlaneMap OpposedPlane(const BearingParameters& b, const RotorModel&, double z) {
  PlaneMap map;
  map.z = z;
  const std::array<double, 3> axis = OpposedAxis(b);
  map.Add(0, axis[0], 0);
  map.Add(1, axis[1], 0);
  return map;
}

}  // namespace

const BearingKind& OpposedBearing() {
  static constexpr BearingKind kind{
      .name = "opposed",
      .acts_on = kOnOpposed,
      .alone = true,
      .coils = [](const BearingParameters& b) { return static_cast<int>(b.opposed.coils); },
      .axes = [](const BearingParameters& b) { return std::vector<std::string>{b.name + ".x"}; },
      .axis = OpposedAxis,
      .read =
          [](const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
            t.Read(b.opposed, kOpposedStatorFields, tolerances);
          },
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.M] kind = \"opposed\"", kOpposedStatorFields);
          },
      .numbers =
          [](BearingParameters& b, const PlaceVisitor& visit) {
            VisitPlaces(b.opposed, kOpposedStatorFields, visit);
          },
      .stator = [](const BearingParameters& b) { return GeometryOf(b.opposed); },
      .force_constant = OpposedForceConstant,
      .own_bias =
          [](const BearingParameters& b) {
            return b.opposed.bias_current > 0 ? b.opposed.bias_current : kRequired;
          },
      .redistribute = DropLostCoils,
      .plane = OpposedPlane,
  };
  return kind;
}

}  // namespace ambrig
