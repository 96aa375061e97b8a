/// Two windings on each side of a thrust disk; one axis along the shaft.
#include <fmt/format.h>

#include "rig/bearing_kinds/bearing_plane.h"
#include "rig/bearing_kinds/one_way.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

constexpr double kLeastBias = 1e-6, kMostBias = 1e3;  // [A]

double ThrustForceConstant(const BearingParameters& b) {
  return 4 * kMu0 * b.thrust.turns * b.thrust.turns * b.thrust.pole_area /
         (b.thrust.gap * b.thrust.gap);
}

/// Ampere-turns 2 (c0 ± v) of a side are shared in proportion to the turns that are left. A side
/// without turns: the other one pulls for forces its own way only, and has no bias,
/// which would press the shaft to its stop. Twice v then gives the largest force of before.
std::string ShareSides(const BearingParameters&, const CoilVector& turns_left, CurrentMap& map) {
  const auto turns = [&](int side) { return turns_left[2 * side] + turns_left[2 * side + 1]; };
  const bool one_way = turns(0) == 0 || turns(1) == 0;
  for (int side = 0; side < 2; ++side) {
    const double a = turns_left[2 * side], b = turns_left[2 * side + 1];
    const double share = a * a + b * b > 0 ? 2 / (a * a + b * b) : 0;
    for (int q = 0; q < 2; ++q) {
      const double scale = share * (q == 0 ? a : b), v = (one_way ? 2 : 1) * scale;
      map.W.row(2 * side + q) << (one_way ? 0 : scale), (side == 0 ? v : -v), 0;
    }
  }
  // A current of the other sign would pull the same way: bridges of four quadrants could drive it.
  if (one_way) map.unipolar = true;
  return turns(0) + turns(1) == 0 ? "none" : one_way ? kOneWay : "exact";
}

}  // namespace

const BearingKind& ThrustBearing() {
  static constexpr BearingKind kind{
      .name = "thrust",
      .acts_on = kOnThrust,
      .axial = true,
      .coils = [](const BearingParameters&) { return kThrustCoils; },
      .axes = AxisAlong,
      .axis = DirectionAlong,
      .read =
          [](const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
            t.Read(b.thrust, kThrustStatorFields, tolerances);
            // A current is a force over the bias: without one there is no current map.
            if (!(b.thrust.bias_current >= kLeastBias))
              t.Fail("bias_current", fmt::format("= {} A, allowed: {} to {} A",
                                                 b.thrust.bias_current, kLeastBias, kMostBias));
          },
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.Z] kind = \"thrust\"", kThrustStatorFields);
          },
      .numbers =
          [](BearingParameters& b, const PlaceVisitor& visit) {
            VisitPlaces(b.thrust, kThrustStatorFields, visit);
          },
      .stator = [](const BearingParameters& b) { return GeometryOf(b.thrust); },
      .force_constant = ThrustForceConstant,
      .own_bias = [](const BearingParameters& b) { return b.thrust.bias_current; },
      .redistribute = ShareSides,
      .plane = PlaneAlong,
      .add_auxiliary = SetAxialStopOf,
  };
  return kind;
}

}  // namespace ambrig
