#include "scenarios/fault_supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/redistribution_setup.h"
#include "scenarios/rig.h"

namespace ambrig {

namespace {

constexpr double kBusSag = 0.9;                               // of the nominal bus
constexpr double kTraceBefore = 5e-3, kTraceAfter = 10e-3;    // [s]

std::string CoilName(const std::string& bearing, int coil) { return fmt::format("{}.coil{}", bearing, coil + 1); }

}  // namespace

struct FaultSupervisor::Watched {
  const BearingParameters* bearing = nullptr;
  std::size_t index = 0;
  std::unique_ptr<BearingDetector> detector;
  std::unique_ptr<RedistributionTable> table;
  Coils turns_left = Coils::Ones();
  int alarmed = -1;                         // coil that the alarm was raised for
};

FaultSupervisor::FaultSupervisor(const RigParameters& nominal, const FaultSupervisorOptions& options)
    : rig_(nominal), options_(options), T_(1 / nominal.amplifier.switching_frequency), feed_(rig_) {
  for (const BearingParameters& b : rig_.bearings) {
    auto w = std::make_unique<Watched>();
    w->bearing = &b;
    w->index = watched_.size();
    const LinkageModel model = LinkageModelOf(b);
    w->detector = std::make_unique<BearingDetector>(model, DetectorSettingsOf(rig_, b, model));
    watched_.push_back(std::move(w));
  }
}

FaultSupervisor::~FaultSupervisor() = default;

const BearingDetector& FaultSupervisor::detector(std::size_t bearing) const { return *watched_[bearing]->detector; }

void FaultSupervisor::WatchBus(double t, double bus, std::vector<RunEvent>& events) {
  const double nominal = rig_.amplifier.bus_voltage;
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

void FaultSupervisor::AfterPeriod(const PeriodMeasurement& m, std::vector<BearingControl>& control,
                                  std::vector<RunEvent>& events) {
  const double bus = m.bearings.front().bus;
  feed_.Read(m);
  WatchBus(m.t + T_, bus, events);
  WatchPositions(m, events);
  for (std::size_t k = 0; k < watched_.size(); ++k) WatchBearing(k, m, control, events);
  if (options_.slopes) TraceSlopes(m.t);
}

void FaultSupervisor::WatchBearing(std::size_t k, const PeriodMeasurement& m, std::vector<BearingControl>& control,
                                   std::vector<RunEvent>& events) {
  Watched& w = *watched_[k];
  const MeasuredPeriod in = feed_.Period(k, m);
  const BearingDetector::Alarm alarm = w.detector->Period(in);
  coil_periods_ += w.bearing->coils();
  if (alarm.coil < 0) return;
  const double t = m.t + T_;
  const std::string name = CoilName(w.bearing->name, alarm.coil);
  if (alarm.raised) w.alarmed = alarm.coil;
  if (alarm.diagnosis.cls != FaultClass::kNone && alarm.coil != w.alarmed) {
    if (w.alarmed >= 0) events.push_back({t, "alarm_cleared", CoilName(w.bearing->name, w.alarmed), "", 0});
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
    events.push_back({t, "classified", CoilName(w.bearing->name, d.coil), ToText(d.cls), d.fraction});
  }
  if (!options_.redistribute) return;
  Disable(w, alarm.diagnosis, control[k]);
  for (const Diagnosis& d : alarm.more) Disable(w, d, control[k]);
  // Set-points that come from outside are not spread over other coils.
  if (m.position_loop) Redistribute(w, alarm.diagnosis, control[k], events);
}

void FaultSupervisor::Disable(Watched& w, const Diagnosis& d, BearingControl& control) {
  const bool lost = d.cls != FaultClass::kPartialShort;
  w.turns_left[d.coil] = lost ? 0 : w.turns_left[d.coil] * (1 - d.fraction);
  if (lost) control.disabled[static_cast<std::size_t>(d.coil)] = true;
}

void FaultSupervisor::Redistribute(Watched& w, const Diagnosis& d, BearingControl& control,
                                   std::vector<RunEvent>& events) {
  const CurrentMap old = control.map;
  std::string cls;
  double resistance = 0;
  if (w.bearing->kind == BearingKind::kRadial) {
    resistance = w.bearing->radial.resistance;
    if (!w.table)
      w.table = std::make_unique<RedistributionTable>(RedistributionProblemOf(rig_, *w.bearing), options_.cache_dir);
    const Distribution found = w.table->Lookup(w.turns_left);
    control.map.W = found.W;
    cls = ToText(found.cls);
  } else if (w.bearing->kind == BearingKind::kThrust) {
    resistance = w.bearing->thrust.resistance;
    cls = "exact";
    for (int side = 0; side < 2; ++side) {
      const double a = w.turns_left[2 * side], b = w.turns_left[2 * side + 1];
      // Ampere-turns 2 (c0 ± v) of the side, shared in proportion to the turns that are left.
      const double share = a * a + b * b > 0 ? 2 / (a * a + b * b) : 0;
      if (share == 0) cls = "none";
      for (int q = 0; q < 2; ++q) {
        const double scale = share * (q == 0 ? a : b);
        control.map.W.row(2 * side + q) << scale, (side == 0 ? scale : -scale), 0;
      }
    }
  } else {
    cls = "none";
    if (w.turns_left[d.coil] == 0) control.map.W.row(d.coil).setZero();
    resistance = w.bearing->opposed.resistance;
  }
  // The force command behind the present set-points, then the set-points that it will have.
  Eigen::Matrix<double, 8, 1> now = Eigen::Matrix<double, 8, 1>::Zero();
  for (int j = 0; j < control.coils; ++j) now[j] = control.set_point[j];
  const Eigen::Matrix<double, 8, 2> gain = old.W.rightCols<2>();
  const Eigen::Matrix2d normal = gain.transpose() * gain + 1e-9 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d v = normal.inverse() * gain.transpose() * (now - old.c0 * old.W.col(0));
  const auto next = control.map.SetPoints(v.x() * old.k * old.c0, v.y() * old.k * old.c0);
  for (int j = 0; j < control.coils; ++j) {
    PowerAmplifier& a = control.amplifier[static_cast<std::size_t>(j)];
    PowerAmplifier held = a;
    held.HoldCurrent(now[j], resistance);
    const double before = held.integral();
    held.HoldCurrent(next[j], resistance * w.turns_left[j]);
    if (now[j] > 0.2 && next[j] > 0.2)
      a.set_integral(a.integral() + held.integral() - before);
    else
      a.set_integral(held.integral());
  }
  events.push_back({d.time, "redistributed", w.bearing->name, cls, 0});
}

void FaultSupervisor::TraceSlopes(double t) {
  if (first_alarm_ >= 0 && t > first_alarm_ + kTraceAfter) return;
  SlopeRow row;
  row.t = t;
  for (const auto& w : watched_) {
    std::array<Lane, 3> lanes{};
    for (int j = 0; j < w->bearing->coils(); ++j)
      w->detector->Band(j, &lanes[0][j], &lanes[1][j], &lanes[2][j]);
    row.bearings.push_back(lanes);
  }
  rows_.push_back(std::move(row));
  while (first_alarm_ < 0 && rows_.front().t < t - kTraceBefore) rows_.pop_front();
}

void FaultSupervisor::Finish(RunResult& result) {
  result.metrics.coil_periods = coil_periods_;
  if (!options_.slopes || rows_.empty()) return;
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
    result.slopes.push_back(std::move(trace));
  }
}

}  // namespace ambrig
