/// What FaultSupervisor does with a coil that has failed, or has fewer turns: switch it off, or
/// count on what is left of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "faulttolerance/supervision/fault_supervisor.h"
#include "faulttolerance/supervision/map_checks.h"
#include "faulttolerance/supervision/watched_bearing.h"
#include "rig/bearing_kinds/one_way.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {
constexpr double kFewestTurns = 0.35;  // left of a coil: with fewer its current loop swings
constexpr double kLittleFalse = 0.5;   // |c| of a coil whose reading is false
}  // namespace

std::string FaultSupervisor::ClassOfMap(Watched& w, const CoilVector& turns_left,
                                        const BearingControl& control) {
  const CoilVector before = w.turns_left;
  if (!w.healthy) w.healthy = control.map;
  CurrentMap map = control.map;
  w.turns_left = turns_left;
  std::string cls = NewMap(w, CommandedForce(control.map, SetPointsOf(control)), &map);
  w.turns_left = before;
  return cls;
}

std::string FaultSupervisor::ClassWithout(Watched& w, int coil, const BearingControl& control) {
  CoilVector left = w.turns_left;
  left[coil] = 0;
  return ClassOfMap(w, left, control);
}

bool FaultSupervisor::NothingElseCarries(Watched& w, const DetectorAlarm& alarm,
                                         const BearingControl& control) {
  if (alarm.diagnosis.cls != FaultClass::kCurrentSensor || !alarm.more.empty() || !w.mapped ||
      w.bearing->kind->eight_poles)
    return false;
  const std::string without = ClassWithout(w, alarm.coil, control);
  if (without == ToText(SolvabilityClass::kNone)) return true;
  // The last winding of a thrust side: with a reading that is wrong by less than half it still
  // pulls as it is asked to, about.
  return without == kOneWay && std::abs(alarm.diagnosis.excess) < kLittleFalse &&
         ClassOfMap(w, w.turns_left, control) != kOneWay;
}

void FaultSupervisor::TakeOutDerated(Watched& w, double t, const BearingControl& control,
                                     SupervisorOutput& out) {
  const int coil = w.probes.MadeWorse(t);
  if (coil < 0 || !w.mapped || !(w.turns_left[coil] > 0)) return;
  const auto derated = (w.turns_left.array() > 0 && w.turns_left.array() < 1).count();
  const std::string cls = derated <= 1 ? ClassWithout(w, coil, control) : "";
  if (cls != ToText(SolvabilityClass::kExact) && cls != "force by force") return;
  w.turns_left[coil] = 0;
  w.detector->SetTurns(coil, 0);
  out.actions.push_back(DisableCoil{w.index, coil});
  w.probes.GivenUp(coil, FaultClass::kPartialShort, t);
  actions_.push_back(
      {t, CoilName(w.bearing->name, coil), "disable", "the orbit grew when it was derated"});
  Redistribute(w, t, control, out);
}

void FaultSupervisor::Disable(Watched& w, const Diagnosis& d, SupervisorOutput& out) {
  const bool lost =
      d.cls != FaultClass::kPartialShort || w.turns_left[d.coil] * (1 - d.fraction) < kFewestTurns;
  w.turns_left[d.coil] = lost ? 0 : std::min(1.0, w.turns_left[d.coil] * (1 - d.fraction));
  if (lost) {
    if (d.cls == FaultClass::kPartialShort) w.detector->SetTurns(d.coil, 0);
    out.actions.push_back(DisableCoil{w.index, d.coil});
    w.probes.GivenUp(d.coil, d.cls, d.time);
  } else {
    w.probes.Derated(d.coil, d.time, ClearanceOf(*w.bearing), d.ripple_fraction > d.fraction);
  }
  const char* closed = d.ripple_fraction > d.fraction ? ", in a closed loop" : "";
  actions_.push_back(
      {d.time, CoilName(w.bearing->name, d.coil), lost ? "disable" : "derate",
       lost ? ToText(d.cls)
            : fmt::format("{}, {:.3f} of the turns{}", ToText(d.cls), d.fraction, closed)});
}

void FaultSupervisor::FollowCarried(Watched& w, const DetectorAlarm& alarm, double t,
                                    bool position_loop, const BearingControl& control,
                                    SupervisorOutput& out) {
  const int coil = alarm.carrying;
  if (!(w.turns_left[coil] > 0)) return;
  w.turns_left[coil] = std::min(1.0, alarm.carried);
  actions_.push_back({t, CoilName(w.bearing->name, coil), "derate",
                      fmt::format("partial-short, {:.3f} of the turns, by its flux since",
                                  1 - w.turns_left[coil])});
  if (position_loop) Redistribute(w, t, control, out);
}

}  // namespace ambrig
