/// kind = "none": no position controller. Held rotors, and records whose currents were measured,
/// need none; a rig file without [controller] has it. The forces that carry the weight at the start
/// stay as they are.
#include "control/interface/controller_kind.h"
#include "control/position/state_space_controller.h"

namespace ambrig {

namespace {

std::unique_ptr<PositionController> MakeNone(const ControllerParameters&,
                                             const ControllerSite& site) {
  const auto n = static_cast<Eigen::Index>(site.axes.size());
  return std::make_unique<StateSpaceController>(
      std::vector<double>{0}, std::vector{StateSpace::Gain(Eigen::MatrixXd::Zero(n, n))},
      site.f_max);
}

}  // namespace

const ControllerKind& NoneKind() {
  static constexpr ControllerKind kind{
      .name = "none",
      .doc = "no position controller: held rotors, records of others",
      .read = [](const TomlTable&, const ControllerNames&, ControllerParameters&) {},
      .make = MakeNone,
  };
  return kind;
}

}  // namespace ambrig
