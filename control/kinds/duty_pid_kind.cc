/// kind = "duty-pid": a PID whose output is the duty of the bridges, without a current
/// loop, as simple levitators have it. It needs amplifiers in voltage mode: what a duty of one does
/// there is a force in the linear map, k c0 U/kp per axis (U: volts from duty 0 to duty 1 at the
/// coil, kp: volts per ampere).
#include "control/interface/controller_kind.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

struct DutyPidSettings : ControllerSettings {
  double kp = kRequired, kd = kRequired, ki = kRequired, derivative_time_constant = kRequired;
};

constexpr Field<DutyPidSettings> kDutyPidFields[] = {
    {"kp", &DutyPidSettings::kp, "1/m", -1e9, 1e9, "duty over position"},
    {"kd", &DutyPidSettings::kd, "s/m", -1e6, 1e6, "duty over velocity"},
    {"ki", &DutyPidSettings::ki, "1/(m s)", -1e12, 1e12, "duty over the integral of the position"},
    {"derivative_time_constant", &DutyPidSettings::derivative_time_constant, "s", 0, 10, "tau_d"},
};

void ReadDutyPid(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  auto settings = std::make_shared<DutyPidSettings>();
  t.Read(*settings, kDutyPidFields);
  c.own = std::move(settings);
}

std::unique_ptr<PositionController> MakeDutyPid(const ControllerParameters& c,
                                                const ControllerSite& site) {
  const auto& s = dynamic_cast<const DutyPidSettings&>(*c.own);
  std::vector<PidParameters> axes;
  for (const ControllerSite::Bearing& b : site.bearings) {
    if (!(b.force_per_duty > 0))
      throw InputError(c.where +
                       ": controller.kind = \"duty-pid\" with amplifiers that follow a current, "
                       "allowed: [amplifier] mode = \"voltage\"");
    const double n = b.force_per_duty;
    for (int side = 0; side < (b.radial ? 2 : 1); ++side)
      axes.push_back(
          {s.kp * n, s.kd * n, s.ki * n, s.derivative_time_constant, site.f_max[axes.size()]});
  }
  return std::make_unique<DecentralisedPid>(std::move(axes), site.period);
}

void DocumentDutyPid(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"duty-pid\"", kDutyPidFields);
}

}  // namespace

const ControllerKind& DutyPidKind() {
  static constexpr ControllerKind kind{
      .name = "duty-pid",
      .doc = "one PID per axis that commands duties",
      .read = ReadDutyPid,
      .make = MakeDutyPid,
      .document = DocumentDutyPid,
  };
  return kind;
}

}  // namespace ambrig
