#include "control/current/control_action.h"

#include "core/base/errors.h"

namespace ambrig {

namespace {

struct Applier {
  std::vector<BearingControl>& control;

  BearingControl& Of(std::size_t bearing) const {
    Require(bearing < control.size(), "a bearing of the rig");
    return control[bearing];
  }
  static std::size_t Coil(const BearingControl& c, int coil) {
    Require(coil >= 0 && coil < c.coils, "a coil of the bearing");
    return static_cast<std::size_t>(coil);
  }
  void operator()(const DisableCoil& a) const {
    BearingControl& c = Of(a.bearing);
    c.disabled[Coil(c, a.coil)] = true;
  }
  void operator()(const EnableCoil& a) const {
    BearingControl& c = Of(a.bearing);
    c.disabled[Coil(c, a.coil)] = false;
    c.probe[a.coil] = 0;
  }
  void operator()(const ProbeCoil& a) const {
    BearingControl& c = Of(a.bearing);
    c.disabled[Coil(c, a.coil)] = !(a.current > 0);
    c.probe[a.coil] = a.current;
  }
  void operator()(const ReplaceMap& a) const {
    BearingControl& c = Of(a.bearing);
    c.map = a.map;
    c.current_transition = a.current_transition;
  }
  void operator()(const SetIntegral& a) const {
    BearingControl& c = Of(a.bearing);
    c.regulator.SetIntegral(Coil(c, a.coil), a.volts);
  }
};

}  // namespace

void Apply(const ControlAction& action, std::vector<BearingControl>& control) {
  std::visit(Applier{control}, action);
}

}  // namespace ambrig
