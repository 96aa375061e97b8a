#include "scenarios/fault_supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/redistribution_setup.h"
#include "scenarios/rig.h"

namespace ambrig {

namespace {

constexpr double kLeastGapSd = 0.01, kLeastLeakageSd = 0.05;  // relative, when the maker says nothing
constexpr double kBusStep = 0.02, kBusSag = 0.9;              // of the nominal bus
constexpr double kTraceBefore = 5e-3, kTraceAfter = 10e-3;    // [s]
constexpr double kCredibleJump = 3e-5;                        // [m] in one controller period: 4700 m/s²

double ToleranceOf(const RigParameters& rig, const std::string& path, double least) {
  for (const Tolerance& t : rig.tolerances)
    if (t.path == path) return std::max(t.sd, least);
  return least;
}

LinkageModel ModelOf(const BearingParameters& b) {
  if (b.kind == BearingKind::kRadial) return MakeLinkageModel(b.radial);
  if (b.kind == BearingKind::kThrust) return MakeLinkageModel(b.thrust);
  const OpposedStatorParameters& p = b.opposed;
  LinkageModel m;  // L(g) = L_inf + L_0/(1 + g/g_c), one "turn"
  m.coupling = Coupling::kNone;
  m.coils = b.coils();
  m.reluctance.per_metre = 1 / (p.gap_constant * p.inductance_near);
  m.reluctance.offset = 1 / p.inductance_near;
  m.reluctance.gap0 = p.gap;
  for (int j = 0; j < m.coils; ++j) {
    m.n[j] = 1;
    m.leakage[j] = p.inductance_far;
    m.resistance[j] = p.resistance;
    m.direction_x[j] = j == 0 ? 1 : -1;
    m.gap_offset[j] = p.gap;
  }
  return m;
}

DetectorSettings SettingsOf(const RigParameters& rig, const BearingParameters& b, const LinkageModel& m) {
  const AmplifierParameters& a = rig.amplifier;
  DetectorSettings s;
  s.sampling.samples = rig.samples_per_period();
  s.sampling.step = 1 / (a.switching_frequency * s.sampling.samples);
  s.sampling.amplifier = &rig.amplifier;
  const double quantum = 2 * a.adc_range / std::exp2(a.adc_bits);
  s.current_noise = std::hypot(a.current_noise, quantum / std::sqrt(12.0));
  s.adc_limit = a.adc_range - 2 * quantum;
  const std::string at = "bearings." + b.name + ".";
  const double gap = m.gap_offset[0];
  s.gap_sd = ToleranceOf(rig, at + "gap", kLeastGapSd * gap) / gap;
  s.leakage_sd = ToleranceOf(rig, at + "leakage_inductance", kLeastLeakageSd * m.leakage[0]);
  // Velocity from three noisy readings, times the flux that a bias current makes.
  const double velocity = 5 * b.sensor.noise * rig.controller.rate;
  const double motion = velocity * m.n[0] * m.n[0] * m.Permeance(0, 0)[0] * BiasCurrent(rig, b) / gap;
  s.voltage_sd = std::sqrt(0.2 * 0.2 + motion * motion + a.bus_noise * a.bus_noise);
  return s;
}

std::string CoilName(const std::string& bearing, int coil) { return fmt::format("{}.coil{}", bearing, coil + 1); }

}  // namespace

struct FaultSupervisor::Watched {
  const BearingParameters* bearing = nullptr;
  std::size_t index = 0;
  std::size_t first_axis = 0;
  std::vector<double> weights;              // of the sensor planes, radial
  std::vector<SensedPlane> planes;
  std::unique_ptr<BearingDetector> detector;
  std::unique_ptr<RedistributionTable> table;
  Coils turns_left = Coils::Ones();
  int alarmed = -1;                         // coil that the alarm was raised for

  bool Uses(int axis) const {
    if (bearing->kind != BearingKind::kRadial) return axis == static_cast<int>(first_axis);
    return std::any_of(planes.begin(), planes.end(),
                       [&](const SensedPlane& p) { return p.x_axis == axis || p.y_axis == axis; });
  }
  void Position(const PositionMonitor& p, double t, double* x, double* y) const {
    *x = *y = 0;
    if (bearing->kind != BearingKind::kRadial) {
      *x = p.At(first_axis, t);
      return;
    }
    for (std::size_t k = 0; k < planes.size(); ++k) {
      *x += weights[k] * p.At(static_cast<std::size_t>(planes[k].x_axis), t);
      *y += weights[k] * p.At(static_cast<std::size_t>(planes[k].y_axis), t);
    }
  }
};

FaultSupervisor::FaultSupervisor(const RigParameters& nominal, const FaultSupervisorOptions& options)
    : rig_(nominal), options_(options), T_(1 / nominal.amplifier.switching_frequency),
      last_bus_(nominal.amplifier.bus_voltage) {
  std::vector<SensedPlane> planes;
  std::vector<double> sensor_z;
  std::size_t axis = 0;
  double largest_noise = 0;
  for (const BearingParameters& b : rig_.bearings) {
    auto w = std::make_unique<Watched>();
    w->bearing = &b;
    w->index = watched_.size();
    w->first_axis = axis;
    const LinkageModel model = ModelOf(b);
    w->detector = std::make_unique<BearingDetector>(model, SettingsOf(rig_, b, model));
    if (b.kind == BearingKind::kRadial) {
      planes.push_back({b.sensor.z, static_cast<int>(axis), static_cast<int>(axis) + 1});
      sensor_z.push_back(b.sensor.z);
    }
    for (const std::string& name : b.Axes()) axis_names_.push_back(name);
    axis += b.Axes().size();
    largest_noise = std::max(largest_noise, b.sensor.noise);
    watched_.push_back(std::move(w));
  }
  for (auto& w : watched_) {
    w->planes = planes;
    w->weights = PlaneWeights(sensor_z, w->bearing->z);
  }
  positions_ = PositionMonitor(axis, kCredibleJump + 40 * largest_noise);
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
  positions_.Read(m.reading_time, *m.readings);
  const int axis = positions_.TakeNewFault();
  if (axis < 0) return;
  const std::string& name = axis_names_[static_cast<std::size_t>(axis)];
  const double t = m.t + T_;
  events.push_back({t, "detected", name, "", 0});
  events.push_back({t, "classified", name, ToText(FaultClass::kPositionSensor), 0});
}

void FaultSupervisor::AfterPeriod(const PeriodMeasurement& m, std::vector<BearingControl>& control,
                                  std::vector<RunEvent>& events) {
  const double bus = m.bearings.front().bus;
  WatchBus(m.t + T_, bus, events);
  WatchPositions(m, events);
  for (std::size_t k = 0; k < watched_.size(); ++k) WatchBearing(k, m, control, events);
  last_bus_ = bus;
  if (options_.slopes) TraceSlopes(m.t);
}

void FaultSupervisor::WatchBearing(std::size_t k, const PeriodMeasurement& m, std::vector<BearingControl>& control,
                                   std::vector<RunEvent>& events) {
  Watched& w = *watched_[k];
  const BearingMeasurement& b = m.bearings[k];
  MeasuredPeriod in;
  in.t = m.t;
  in.adc = b.adc;
  in.duty = b.duty;
  in.bus = 0.5 * (b.bus + last_bus_);
  w.Position(positions_, m.t, &in.x0, &in.y0);
  w.Position(positions_, m.t + T_, &in.x1, &in.y1);
  // Without its position a bearing's inductances are not known: nothing can be concluded.
  bool sensed = positions_.ready(m.t);
  for (std::size_t a = 0; a < axis_names_.size(); ++a)
    if (positions_.faulty(a) && w.Uses(static_cast<int>(a))) sensed = false;
  in.comparable = sensed && std::abs(b.bus - last_bus_) < kBusStep * rig_.amplifier.bus_voltage;
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
  if (!options_.redistribute) return;
  Disable(w, alarm.diagnosis, control[k]);
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
