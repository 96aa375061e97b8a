/// kind = "h-infinity": loop shaping on the linear plant.
#include "control/kinds/read_system.h"
#include "control/position/state_space_controller.h"
#include "control/synthesis/h_infinity.h"

namespace ambrig {

namespace {

void ReadHInfinity(const TomlTable& t, const ControllerNames& names, ControllerParameters& c) {
  t.Read(c.h_infinity, kHInfinityFields);
  ReadSynthesis(t, names, c);
}

std::unique_ptr<PositionController> MakeHInfinity(const ControllerParameters& c,
                                                  const ControllerSite& site) {
  std::vector<StateSpace> points;
  for (const double speed : c.speeds) {
    // of readings; StateSpaceController works on e = -y
    StateSpace k = DesignHInfinity(site.plant(c, speed), c.h_infinity, c.where).controller;
    k.B = -k.B;
    k.D = -k.D;
    points.push_back(std::move(k));
  }
  return std::make_unique<StateSpaceController>(c.speeds, points, site.f_max);
}

/// With the tables that every synthesis has.
void DocumentHInfinity(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"h-infinity\"", kHInfinityFields);
  AddRows(rows, "[[controller.plane]]", kPlaneWeightFields);
  AddRows(rows, "[controller.modes]", kModeWeightFields);
}

}  // namespace

const ControllerKind& HInfinityKind() {
  static constexpr ControllerKind kind{
      .name = "h-infinity",
      .doc = "H-infinity synthesis",
      .read = ReadHInfinity,
      .make = MakeHInfinity,
      .document = DocumentHInfinity,
      .designed = true,
  };
  return kind;
}

}  // namespace ambrig
