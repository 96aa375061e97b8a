/// Eight poles round the shaft, a floating rotor between them; two axes.
#include <fmt/format.h>

#include "rig/bearing_kinds/bearing_plane.h"
#include "rig/parameters/bearing_kind.h"

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
      .axes = AxesAcross,
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
      .plane = PlaneAcross,
      .add_auxiliary = AddAuxiliaryAtPlane,
  };
  return kind;
}

}  // namespace ambrig
