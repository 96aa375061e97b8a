/// The maps that FaultSupervisor goes to when coils are lost or come back.
#include <cmath>

#include "faulttolerance/redistribution/redistribution_setup.h"
#include "faulttolerance/supervision/failure_map.h"
#include "faulttolerance/supervision/fault_supervisor.h"
#include "faulttolerance/supervision/map_checks.h"
#include "faulttolerance/supervision/stator_failure_map.h"
#include "faulttolerance/supervision/watched_bearing.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {
constexpr double kVoltageShare = 0.8;  // of the bus, to change currents with
}

void FaultSupervisor::Redistribute(Watched& w, double t, const BearingControl& control,
                                   SupervisorOutput& out) {
  if (!w.healthy) w.healthy = control.map;
  ReplaceMap change{w.index, control.map, control.current_transition, w.turns_left};
  CurrentMap& map = change.map;
  const CoilVector now = SetPointsOf(control);
  const Eigen::Vector2d force = CommandedForce(control.map, now);
  std::string cls = "exact";
  if ((w.turns_left.array() == 1).all())
    map = *w.healthy;
  else
    cls = NewMap(w, force, &map);
  TellRedistribution(w, t, cls, out.events);
  if (!w.mapped) {  // its currents do not change
    out.actions.push_back(std::move(change));
    return;
  }
  if (w.bearing->kind->eight_poles)
    change.current_transition = NewCurrentTransition(w, map, force, control);
  // The set-points that come next.
  CoilVector next = map.allocation ? now : map.SetPoints(force.x(), force.y());
  if (change.current_transition) next = change.current_transition->Clone()->Step(next, force);
  out.actions.push_back(std::move(change));
  MoveIntegrals(w, control, next, out);
}

void FaultSupervisor::TellRedistribution(const Watched& w, double t, const std::string& cls,
                                         std::vector<RunEvent>& events) {
  const bool whole = (w.turns_left.array() == 1).all();
  if (w.mapped && cls != ToText(SolvabilityClass::kNone)) {
    events.push_back({t, "redistributed", w.bearing->name, cls, 0});
  } else if (!whole) {
    events.push_back(
        {t, "not_redistributed", w.bearing->name, w.mapped ? cls : "own set-points", 0});
  }
}

void FaultSupervisor::MoveIntegrals(const Watched& w, const BearingControl& control,
                                    const CoilVector& next, SupervisorOutput& out) {
  const double resistance = CoilResistance(*w.bearing);
  for (int j = 0; j < control.coils; ++j) {
    const double now = control.set_point[j];
    CurrentRegulator held = control.regulator[static_cast<std::size_t>(j)];
    const double integral = held.integral();
    held.HoldCurrent(now, resistance);
    const double before = held.integral();
    held.HoldCurrent(next[j], resistance * w.turns_left[j]);
    const bool moves = now > kInterruptedCurrent && next[j] > kInterruptedCurrent;
    out.actions.push_back(
        SetIntegral{w.index, j, moves ? integral + held.integral() - before : held.integral()});
  }
}

std::string FaultSupervisor::NewMap(Watched& w, const Eigen::Vector2d& force, CurrentMap* map) {
  if (const auto network = w.bearing->kind->stator(*w.bearing).network) {
    *map = *w.healthy;
    const int axes = w.bearing->kind->two_axes ? 2 : 1;
    const auto share = WeightShares(*rig_)[w.index];
    return StatorMapAfterFailure(StatorProblemOf(network, axes, *w.healthy, w.turns_left,
                                                 {share[0], axes > 1 ? share[1] : 0}),
                                 options_.stiffness_compensation, map);
  }
  if (!w.bearing->kind->eight_poles) {
    map->W = w.healthy->W;
    map->unipolar = w.healthy->unipolar;
    return w.bearing->kind->redistribute(*w.bearing, w.turns_left, *map);
  }
  if (!w.table)
    w.table = std::make_unique<RedistributionTable>(RedistributionProblemOf(rig_, *w.bearing),
                                                    options_.cache_dir);
  return MapAfterFailure(*w.table, w.turns_left, force,
                         {options_.redistribution, options_.stiffness_compensation}, map);
}

std::unique_ptr<CurrentTransition> FaultSupervisor::NewCurrentTransition(
    const Watched& w, const CurrentMap& map, const Eigen::Vector2d& force,
    const BearingControl& control) const {
  TransitionStart s;
  s.bearing = RedistributionProblemOf(rig_, *w.bearing);
  s.bearing.turns_left = w.turns_left;
  const CurrentMap& old = control.map;
  for (int j = 0; j < 8; ++j)
    if (w.turns_left[j] > 0) s.now[j] = control.set_point[j];
  // Without a matrix the bias is what the currents without a force would be.
  s.bias_before = old.allocation ? s.now : CoilVector(old.c0 * old.W.col(0));
  s.bias_after = map.allocation ? map.allocation->Step(force.x(), force.y(), 0, 0)
                                : CoilVector(map.c0 * map.W.col(0));
  s.leakage = w.bearing->radial.leakage_inductance;
  s.voltage = kVoltageShare * rig_->amplifier.bus_voltage;
  s.period = 1 / rig_->controller.rate;
  return MakeCurrentTransition(options_.current_transition, s);
}

}  // namespace ambrig
