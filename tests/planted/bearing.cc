// catalogue: PlantedBearing
/// Planted by tools/planted_change.py: an axial bearing with one winding on each side of its disk,
/// with parameters of its own that no other part of the program knows.
#include "effects/plant.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

struct PlantedStator {
  double turns = kRequired;
  double pole_area = kRequired;
  double gap = kRequired;
  double leakage_inductance = kRequired;
  double resistance = kRequired;
  double bias_current = kRequired;
};

constexpr Field<PlantedStator> kStatorFields[] = {
    {"turns", &PlantedStator::turns, "-", 1, 1e4, "N, per side"},
    {"pole_area", &PlantedStator::pole_area, "m2", 1e-8, 1.0, "A, per ring"},
    {"gap", &PlantedStator::gap, "m", 1e-6, 1e-1, "g0, each side"},
    {"leakage_inductance", &PlantedStator::leakage_inductance, "H", 1e-9, 1.0, "L_l"},
    {"resistance", &PlantedStator::resistance, "ohm", 1e-6, 1e4, "R"},
    {"bias_current", &PlantedStator::bias_current, "A", 0, 1e3, "c0"},
};

const PlantedStator& StatorOf(const BearingParameters& b) {
  return std::any_cast<const PlantedStator&>(b.own);
}

/// phi = mu0 A N i/(2 g), f = phi²/(mu0 A) of each side.
StatorGeometry Geometry(const BearingParameters& b) {
  const PlantedStator& p = StatorOf(b);
  StatorGeometry g;
  g.coupling = Coupling::kNone;
  g.coils = 2;
  g.reluctance.per_metre = 2 / (kMu0 * p.pole_area);
  g.reluctance.gap0 = p.gap;
  for (int j = 0; j < g.coils; ++j) {
    g.n[j] = p.turns;
    g.leakage[j] = p.leakage_inductance;
    g.resistance[j] = p.resistance;
    g.direction_x[j] = j == 0 ? 1 : -1;
    g.gap_offset[j] = p.gap;
  }
  return g;
}

}  // namespace

const BearingKind& PlantedBearing() {
  static constexpr BearingKind kind{
      .name = "planted-axial",
      .acts_on = kOnThrust,
      .axial = true,
      .coils = [](const BearingParameters&) { return 2; },
      .axes = [](const BearingParameters&) { return std::vector<std::string>{"z"}; },
      .axis =
          [](const BearingParameters&) {
            return std::array<double, 3>{0, 0, 1};
          },
      .read =
          [](const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
            PlantedStator p;
            t.Read(p, kStatorFields, tolerances);
            b.own = p;
          },
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.Z] kind = \"planted-axial\"", kStatorFields);
          },
      .numbers =
          [](BearingParameters& b, const PlaceVisitor& visit) {
            VisitPlaces(std::any_cast<PlantedStator&>(b.own), kStatorFields, visit);
          },
      .stator = Geometry,
      .force_constant =
          [](const BearingParameters& b) {
            const PlantedStator& p = StatorOf(b);
            return kMu0 * p.turns * p.turns * p.pole_area / (p.gap * p.gap);
          },
      .own_bias = [](const BearingParameters& b) { return StatorOf(b).bias_current; },
      .redistribute = DropLostCoils,
      .plane =
          [](const BearingParameters&, const RotorModel&, double z) {
            PlaneMap map;
            map.z = z;
            map.Add(2, 1, 0);
            return map;
          },
      .add_auxiliary = [](const BearingParameters& b,
                          RotorModel& rotor) { rotor.SetAxialStop(*b.auxiliary); },
  };
  return kind;
}

}  // namespace ambrig
