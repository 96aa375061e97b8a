// catalogue: PlantedKind
/// Planted by tools/planted_change.py: kind = "planted", proportional and filtered derivative
/// action on every axis,  f = (stiffness + damping s/(1 + s lag)) e,  sampled by the bilinear map.
#include "control/interface/controller_kind.h"
#include "control/position/state_space_controller.h"

namespace ambrig {

namespace {

struct Gains : ControllerSettings {
  double stiffness = kRequired;  // [N/m]
  double damping = kRequired;    // [N s/m]
  double lag = 1.5e-4;           // [s]
};

constexpr Field<Gains> kFields[] = {
    {"stiffness", &Gains::stiffness, "N/m", 0, 1e9, "of every axis"},
    {"damping", &Gains::damping, "N s/m", 0, 1e7, "of every axis"},
    {"lag", &Gains::lag, "s", 1e-6, 1, "of the derivative"},
};

void Read(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  auto gains = std::make_shared<Gains>();
  t.Read(*gains, kFields);
  c.own = std::move(gains);
}

std::unique_ptr<PositionController> Make(const ControllerParameters& c,
                                         const ControllerSite& site) {
  const auto& g = static_cast<const Gains&>(*c.own);
  const StateSpace axis =
      Bilinear(FromTransferFunction({g.stiffness * g.lag + g.damping, g.stiffness}, {g.lag, 1}),
               site.period);
  return std::make_unique<StateSpaceController>(
      std::vector<double>{0},
      std::vector<StateSpace>{Append(std::vector<StateSpace>(site.axes.size(), axis))}, site.f_max);
}

void Document(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"planted\"", kFields);
}

}  // namespace

const ControllerKind& PlantedKind() {
  static constexpr ControllerKind kind{
      .name = "planted",
      .doc = "proportional and derivative action",
      .read = Read,
      .make = Make,
      .document = Document,
  };
  return kind;
}

}  // namespace ambrig
