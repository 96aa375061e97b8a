#include "faulttolerance/supervision/fault_supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "faulttolerance/redistribution/inverse_allocation.h"
#include "faulttolerance/redistribution/redistribution_setup.h"
#include "faulttolerance/supervision/map_checks.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kBusSag = 0.9;  // of the nominal bus
// of the nominal bus, half the way to a sag: no noise may go it [sd]
constexpr double kBusUncertainty = 0.05, kBusNoise = 6;
constexpr double kVoltageShare = 0.8;                       // of the bus, to change currents with
constexpr double kTraceBefore = 5e-3, kTraceAfter = 10e-3;  // [s]

std::string CoilName(const std::string& bearing, int coil) {
  return fmt::format("{}.coil{}", bearing, coil + 1);
}

}  // namespace

struct FaultSupervisor::Watched {
  const BearingParameters* bearing = nullptr;
  std::size_t index = 0;
  std::unique_ptr<RunDetector> detector;
  std::unique_ptr<RedistributionTable> table;
  CoilVector turns_left = CoilVector::Ones();
  int alarmed = -1;       // coil that the alarm was raised for
  bool doubtful = false;  // its detector has doubted its model in this run
};

FaultSupervisor::FaultSupervisor(const NominalRig& nominal, const FaultSupervisorOptions& options)
    : rig_(nominal),
      options_(options),
      T_(1 / nominal->amplifier.switching_frequency),
      feed_(rig_) {
  const AmplifierParameters& a = rig_->amplifier;
  // Mean of as many readings as their noise asks for: one, of a quiet one.
  const double noisy = kBusNoise * a.bus_noise / (kBusUncertainty * a.bus_voltage);
  bus_weight_ = 1 / std::max(1.0, noisy * noisy);
  bus_ = a.bus_voltage;
  for (const BearingParameters& b : rig_->bearings) {
    auto w = std::make_unique<Watched>();
    w->bearing = &b;
    w->index = watched_.size();
    w->detector =
        MakeRunDetector(rig_->detection.kind, rig_->detection.where, RunDetectorSetupOf(rig_, b));
    watched_.push_back(std::move(w));
  }
}

FaultSupervisor::~FaultSupervisor() = default;

void FaultSupervisor::WatchBus(double t, double reading, std::vector<RunEvent>& events) {
  const double nominal = rig_->amplifier.bus_voltage;
  const double bus = bus_ += bus_weight_ * (reading - bus_);
  if (!bus_sagged_ && bus < kBusSag * nominal) {
    bus_sagged_ = true;
    events.push_back({t, "detected", "rig", "", 0});
    events.push_back({t, "classified", "rig", ToText(FaultClass::kBusSag), 0});
  } else if (bus_sagged_ && bus > 0.5 * (1 + kBusSag) * nominal) {
    bus_sagged_ = false;
    events.push_back({t, "alarm_cleared", "rig", ToText(FaultClass::kBusSag), 0});
  }
}

void FaultSupervisor::WatchPositions(const PeriodMeasurement& m, std::vector<RunEvent>& events) {
  const std::string name = feed_.TakeFaultyAxis();
  if (name.empty()) return;
  const double t = m.t + T_;
  events.push_back({t, "detected", name, "", 0});
  events.push_back({t, "classified", name, ToText(FaultClass::kPositionSensor), 0});
}

void FaultSupervisor::AfterPeriod(const PeriodMeasurement& m,
                                  const std::vector<BearingControl>& control,
                                  SupervisorOutput& out) {
  const double bus = m.bearings.front().bus;
  feed_.Read(m);
  WatchBus(m.t + T_, bus, out.events);
  WatchPositions(m, out.events);
  for (std::size_t k = 0; k < watched_.size(); ++k) WatchBearing(k, m, control[k], out);
  if (options_.slopes) TraceSlopes(m.t);
}

void FaultSupervisor::WatchBearing(std::size_t k, const PeriodMeasurement& m,
                                   const BearingControl& control, SupervisorOutput& out) {
  Watched& w = *watched_[k];
  std::vector<RunEvent>& events = out.events;
  MeasuredPeriod in = feed_.Period(k, m);
  in.set_point = &control.commanded;
  const DetectorAlarm alarm = w.detector->Period(in);
  coil_periods_ += w.bearing->coils();
  if (w.detector->doubtful() && !w.doubtful) {
    w.doubtful = doubtful_ = true;
    events.push_back({m.t + T_, "doubtful", w.bearing->name, "model doubtful", 0});
  }
  if (alarm.coil < 0) return;
  const double t = m.t + T_;
  const std::string name = CoilName(w.bearing->name, alarm.coil);
  if (alarm.raised) w.alarmed = alarm.coil;
  if (alarm.diagnosis.cls != FaultClass::kNone && alarm.coil != w.alarmed) {
    if (w.alarmed >= 0)
      events.push_back({t, "alarm_cleared", CoilName(w.bearing->name, w.alarmed), "", 0});
    events.push_back({t, "detected", name, "", 0});
  }
  if (alarm.diagnosis.cls != FaultClass::kNone || alarm.cleared) w.alarmed = -1;
  if (alarm.raised) {
    events.push_back({t, "detected", name, "", 0});
    if (first_alarm_ < 0) {
      first_alarm_ = t;
      alarm_bearing_ = k;
      alarm_coil_ = alarm.coil;
    }
  }
  if (alarm.cleared) events.push_back({t, "alarm_cleared", name, "", 0});
  if (alarm.diagnosis.cls == FaultClass::kNone) return;
  events.push_back({t, "classified", name, ToText(alarm.diagnosis.cls), alarm.diagnosis.fraction});
  for (const Diagnosis& d : alarm.more) {
    events.push_back({t, "detected", CoilName(w.bearing->name, d.coil), "", 0});
    events.push_back(
        {t, "classified", CoilName(w.bearing->name, d.coil), ToText(d.cls), d.fraction});
  }
  if (!options_.redistribute || w.detector->doubtful()) return;
  Disable(w, alarm.diagnosis, out);
  for (const Diagnosis& d : alarm.more) Disable(w, d, out);
  // Set-points that come from outside are not spread over other coils.
  if (m.position_loop) Redistribute(w, alarm.diagnosis, control, out);
}

void FaultSupervisor::Disable(Watched& w, const Diagnosis& d, SupervisorOutput& out) {
  const bool lost = d.cls != FaultClass::kPartialShort;
  w.turns_left[d.coil] = lost ? 0 : w.turns_left[d.coil] * (1 - d.fraction);
  if (lost) out.actions.push_back(DisableCoil{w.index, d.coil});
  actions_.push_back(
      {d.time, CoilName(w.bearing->name, d.coil), lost ? "disable" : "derate",
       lost ? ToText(d.cls) : fmt::format("{}, {:.3f} of the turns", ToText(d.cls), d.fraction)});
}

void FaultSupervisor::Redistribute(Watched& w, const Diagnosis& d, const BearingControl& control,
                                   SupervisorOutput& out) {
  ReplaceMap change{w.index, control.map, control.current_transition};
  CurrentMap& map = change.map;
  CoilVector now = CoilVector::Zero();
  for (int j = 0; j < control.coils; ++j) now[j] = control.set_point[j];
  const Eigen::Vector2d force = CommandedForce(control.map, now);
  std::string cls;
  if (w.bearing->kind == BearingKind::kRadial) {
    cls = NewMap(w, force, &map);
    change.current_transition = NewCurrentTransition(w, map, force, control);
  } else {
    cls = NewMapOfSides(w, d, &map);
  }
  // The set-points that come next.
  CoilVector next = map.allocation ? now : map.SetPoints(force.x(), force.y());
  if (change.current_transition) next = change.current_transition->Clone()->Step(next, force);
  out.actions.push_back(std::move(change));
  MoveIntegrals(w, control, next, out);
  out.events.push_back({d.time, "redistributed", w.bearing->name, cls, 0});
}

std::string FaultSupervisor::NewMapOfSides(const Watched& w, const Diagnosis& d, CurrentMap* map) {
  if (w.bearing->kind != BearingKind::kThrust) {
    if (w.turns_left[d.coil] == 0) map->W.row(d.coil).setZero();
    return "none";
  }
  std::string cls = "exact";
  for (int side = 0; side < 2; ++side) {
    const double a = w.turns_left[2 * side], b = w.turns_left[2 * side + 1];
    // Ampere-turns 2 (c0 ± v) of the side, shared in proportion to the turns that are left.
    const double share = a * a + b * b > 0 ? 2 / (a * a + b * b) : 0;
    if (share == 0) cls = "none";
    for (int q = 0; q < 2; ++q) {
      const double scale = share * (q == 0 ? a : b);
      map->W.row(2 * side + q) << scale, (side == 0 ? scale : -scale), 0;
    }
  }
  return cls;
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
    const bool moves = now > 0.2 && next[j] > 0.2;
    out.actions.push_back(
        SetIntegral{w.index, j, moves ? integral + held.integral() - before : held.integral()});
  }
}

std::string FaultSupervisor::NewMap(Watched& w, const Eigen::Vector2d& force, CurrentMap* map) {
  if (!w.table)
    w.table = std::make_unique<RedistributionTable>(RedistributionProblemOf(rig_, *w.bearing),
                                                    options_.cache_dir);
  RedistributionProblem left = w.table->problem();
  const Eigen::Matrix2d healthy =
      Describe(left, SolvabilityClass::kExact, HealthyDistribution(left)).stiffness;
  left.turns_left = w.turns_left;
  map->allocation = nullptr;
  map->stiffness_change.setZero();
  const Distribution found = w.table->Lookup(w.turns_left);
  map->W = found.W;
  const bool matrix = options_.redistribution == "matrix" ||
                      (options_.redistribution == "auto" && GivesForce(force, left, found, *map));
  if (!matrix) {
    ForceInverse inverse(left);
    if (inverse.Start(force)) {
      map->allocation = std::make_shared<InverseAllocation>(inverse, healthy);
      return "force by force";
    }
  }
  if (options_.stiffness_compensation)
    map->stiffness_change = DestabilisingPart(healthy - found.stiffness);
  return ToText(found.cls);
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

void FaultSupervisor::TraceSlopes(double t) {
  if (first_alarm_ >= 0 && t > first_alarm_ + kTraceAfter) return;
  SlopeRow row;
  row.t = t;
  for (const auto& w : watched_) {
    std::array<Lane, 3> lanes{};
    for (int j = 0; j < w->bearing->coils(); ++j) {
      const SlopeBand band = w->detector->Band(j);
      lanes[0][j] = band.slope;
      lanes[1][j] = band.expected;
      lanes[2][j] = band.half_width;
    }
    row.bearings.push_back(lanes);
  }
  rows_.push_back(std::move(row));
  while (first_alarm_ < 0 && rows_.front().t < t - kTraceBefore) rows_.pop_front();
}

SupervisorSummary FaultSupervisor::Summary() const {
  SupervisorSummary summary;
  summary.coil_periods = coil_periods_;
  summary.actions = actions_;
  summary.doubtful = doubtful_;
  if (!options_.slopes || rows_.empty()) return summary;
  const Watched& w = *watched_[alarm_bearing_];
  const int coils = w.bearing->coils();
  std::vector<int> shown;
  for (int step : {0, 1, coils - 1, coils / 2}) {
    const int j = (alarm_coil_ + step) % coils;
    if (std::find(shown.begin(), shown.end(), j) == shown.end()) shown.push_back(j);
  }
  for (int j : shown) {
    SlopeTrace trace;
    trace.coil = CoilName(w.bearing->name, j);
    for (const SlopeRow& row : rows_) {
      const std::array<Lane, 3>& a = row.bearings[w.index];
      trace.t.push_back(row.t);
      trace.slope.push_back(a[0][j]);
      trace.low.push_back(a[1][j] - a[2][j]);
      trace.high.push_back(a[1][j] + a[2][j]);
    }
    summary.slopes.push_back(std::move(trace));
  }
  return summary;
}

}  // namespace ambrig
