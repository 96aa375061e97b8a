/// Eight poles round the shaft, a floating rotor between them; two axes.
#include <fmt/format.h>

#include <cmath>

#include "effects/plant.h"
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

}  // namespace

const BearingKind& RadialBearing() {
  static constexpr BearingKind kind{
      .name = "radial",
      .acts_on = kOnRadial,
      .two_axes = true,
      .eight_poles = true,
      .coils = [](const BearingParameters&) { return kPoles; },
      .axes =
          [](const BearingParameters& b) {
            return std::vector<std::string>{b.name + ".x", b.name + ".y"};
          },
      .read = ReadRadial,
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.A] kind = \"radial\"", kRadialStatorFields);
          },
      .numbers =
          [](BearingParameters& b, const PlaceVisitor& visit) {
            VisitPlaces(b.radial, kRadialStatorFields, visit);
          },
      .stator = [](const BearingParameters& b) { return GeometryOf(b.radial); },
      .force_constant =
          [](const BearingParameters& b) { return RadialStator(b.radial).ForceConstant(); },
      .own_bias = [](const BearingParameters&) { return kRequired; },
      .plane = [](const BearingParameters&, const RotorModel& rotor,
                  double z) { return rotor.MakePlane(z); },
      .add_auxiliary =
          [](const BearingParameters& b, RotorModel& rotor) {
            rotor.AddAuxiliary(b.name, std::isnan(b.auxiliary_z) ? b.z : b.auxiliary_z,
                               *b.auxiliary);
          },
  };
  return kind;
}

}  // namespace ambrig
