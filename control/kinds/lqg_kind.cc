/// kind = "lqg": linear quadratic regulator and Kalman filter on the linear plant.
#include "control/kinds/read_system.h"
#include "control/synthesis/lqg.h"

namespace ambrig {

namespace {

void ReadLqg(const TomlTable& t, const ControllerNames& names, ControllerParameters& c) {
  t.Read(c.lqg, kLqgFields);
  ReadSynthesis(t, names, c);
}

std::unique_ptr<PositionController> MakeLqg(const ControllerParameters& c,
                                            const ControllerSite& site) {
  std::vector<LqgDesign> designs;
  for (const double speed : c.speeds)
    designs.push_back(DesignLqg(site.plant(c, speed), c.lqg, c.where));
  return std::make_unique<LqgController>(c.speeds, std::move(designs), site.f_max, site.period);
}

void DocumentLqg(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"lqg\"", kLqgFields);
}

}  // namespace

const ControllerKind& LqgKind() {
  static constexpr ControllerKind kind{
      .name = "lqg",
      .doc = "state feedback and Kalman filter",
      .read = ReadLqg,
      .make = MakeLqg,
      .document = DocumentLqg,
      .designed = true,
  };
  return kind;
}

}  // namespace ambrig
