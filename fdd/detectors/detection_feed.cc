#include "fdd/detectors/detection_feed.h"

#include <algorithm>
#include <cmath>

#include "actuators/electronics/adc.h"
#include "core/math/line_weights.h"
#include "fdd/learning/commissioning_file.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

// relative, when the maker says nothing
constexpr double kLeastGapSd = 0.01, kLeastLeakageSd = 0.05;
// of the nominal bus, within one period
constexpr double kBusStep = 0.02;
// of the nominal bus: below, drops of switches and diodes are no small part of a coil's voltage
constexpr double kLeastBus = 0.5;
// [sd] between two readings: never in 1e8 periods
constexpr double kBusNoise = 8;
// [m] in one controller period, whatever its length: 4700 m/s² at 12.5 kHz, less at lower rates
constexpr double kCredibleJump = 3e-5;

// change of velocity over speed at an impact: 1 + restitution, and some friction
constexpr double kThrownBack = 2.3;
// departures of the parabola in the impact's three steps, over one step's change
constexpr double kParabola = 2;
constexpr double kReach = 0.05;  // of the clearance: the maker's tolerance
constexpr int kReadingsOfParabola = 3;

double Length(double x, double y) { return std::sqrt(x * x + y * y); }

double ToleranceOf(const RigParameters& rig, const std::string& path, double least) {
  for (const Tolerance& t : rig.tolerances)
    if (t.path == path) return std::max(t.sd, least);
  return least;
}

}  // namespace

LinkageModel LinkageModelOf(const BearingParameters& b) { return {b.kind->stator(b)}; }

DetectorSettings DetectorSettingsOf(const NominalRig& nominal, const BearingParameters& b,
                                    const LinkageModel& m) {
  const RigParameters& rig = *nominal;
  const AmplifierParameters& a = rig.amplifier;
  DetectorSettings s;
  s.sampling.samples = rig.samples_per_period();
  s.sampling.step = 1 / (a.switching_frequency * s.sampling.samples);
  s.sampling.amplifier = &rig.amplifier;
  const double quantum = Quantiser(a.adc_bits, a.adc_range).step;
  s.current_noise = std::hypot(a.current_noise, quantum / std::sqrt(12.0));
  s.current_quantum = quantum;
  s.adc_limit = a.adc_range - 2 * quantum;
  const std::string at = "bearings." + b.name + ".";
  const double gap = m.gap_offset[0];
  s.gap_sd = ToleranceOf(rig, at + "gap", kLeastGapSd * gap) / gap;
  s.leakage_sd = ToleranceOf(rig, at + "leakage_inductance", kLeastLeakageSd * m.leakage[0]);
  // Velocity from three noisy readings, times the flux that a bias current makes.
  const double velocity = 5 * b.sensor.noise * rig.controller.rate;
  const double motion =
      velocity * m.n[0] * m.n[0] * m.Permeance(0, 0)[0] * BiasCurrent(rig, b) / gap;
  s.voltage_sd = std::sqrt(0.2 * 0.2 + motion * motion + a.bus_noise * a.bus_noise);
  return s;
}

RunDetectorSetup RunDetectorSetupOf(const NominalRig& rig, const BearingParameters& b) {
  RunDetectorSetup s;
  s.model = LinkageModelOf(b);
  s.settings = DetectorSettingsOf(rig, b, s.model);
  s.bearing = b.name;
  s.threshold = rig->detection.threshold;
  s.commissioning = rig->detection.commissioning;
  if (s.commissioning == "none") {
    s.commissioning.clear();
  } else if (s.commissioning.empty()) {
    // What was learnt of other nominal values is no commissioning of this rig.
    const std::string beside = CommissioningFileOf(rig->file);
    if (FitsBearing(beside, b.name, s.model, rig->amplifier)) s.commissioning = beside;
  }
  return s;
}

DetectionFeed::DetectionFeed(const NominalRig& nominal)
    : rig_(nominal),
      T_(1 / nominal->amplifier.switching_frequency),
      bus_(nominal->amplifier.bus_voltage),
      last_bus_(nominal->amplifier.bus_voltage) {
  std::vector<double> sensor_z;
  double largest_noise = 0;
  for (const BearingParameters& b : rig_->bearings) {
    const std::size_t axis = axis_names_.size();
    if (b.kind->two_axes) {
      planes_.push_back({b.sensor.z, static_cast<int>(axis), static_cast<int>(axis) + 1});
      sensor_z.push_back(b.sensor.z);
    }
    for (const std::string& name : b.Axes()) axis_names_.push_back(name);
    largest_noise = std::max(largest_noise, b.sensor.noise);
    views_.push_back({&b, axis, axis_names_.size(), b.kind->axial ? 1U : 0U, {}, {}, {}});
  }
  for (View& v : views_) {
    v.weights = LineWeights(sensor_z, v.bearing->z);
    const double stop = v.bearing->auxiliary_z;
    v.auxiliary_weights = std::isnan(stop) ? v.weights : LineWeights(sensor_z, stop);
  }
  struck_.assign(axis_names_.size(), 0.0);
  start_.assign(axis_names_.size(), 0.0);
  end_ = start_;
  positions_ =
      PositionMonitor(axis_names_.size(), kCredibleJump + 40 * largest_noise, largest_noise);
}

template <class Of>
void DetectionFeed::Place(const View& v, const std::vector<double>& weights, const Of& of,
                          double* x, double* y) const {
  *x = *y = 0;
  if (!v.bearing->kind->two_axes) {
    *x = of(v.first_axis);
    return;
  }
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    *x += weights[k] * of(static_cast<std::size_t>(planes_[k].x_axis));
    *y += weights[k] * of(static_cast<std::size_t>(planes_[k].y_axis));
  }
}

void DetectionFeed::WatchImpacts() {
  const double step = positions_.step();
  for (Impacts& one : impacts_) {
    one.travel = 0;
    ++one.readings_since;
  }
  for (const View& v : views_) {
    Impacts& one = impacts_[v.group];
    double x[3], y[3];
    for (std::size_t k = 0; k < 3; ++k)
      Place(
          v, v.auxiliary_weights, [&](std::size_t axis) { return positions_.Recent(axis, k); },
          &x[k], &y[k]);
    const double moved =
        std::max(Length(x[0] - x[1], y[0] - y[1]), Length(x[1] - x[2], y[1] - y[2]));
    one.travel = std::max(one.travel, moved);
    const auto& stop = v.bearing->auxiliary;
    if (stop && Length(x[0], y[0]) + moved > (1 - kReach) * stop->clearance) one.readings_since = 0;
  }
  for (View& v : views_) {
    const Impacts& one = impacts_[v.group];
    const double change = one.readings_since <= kReadingsOfParabola ? kThrownBack * one.travel : 0;
    double departure = 0;
    for (std::size_t a = 0; a < axis_names_.size(); ++a)
      if (Uses(v, a)) departure = std::max(departure, positions_.Departure(a));
    v.uncertainty.position = change + kParabola * departure;
    v.uncertainty.velocity = v.uncertainty.position / step;
    for (std::size_t a = v.first_axis; a < v.end_axis; ++a) struck_[a] = kParabola * change;
  }
}

bool DetectionFeed::Uses(const View& v, std::size_t axis) const {
  if (!v.bearing->kind->two_axes) return axis == v.first_axis;
  const int a = static_cast<int>(axis);
  return std::any_of(planes_.begin(), planes_.end(),
                     [&](const SensedPlane& p) { return p.x_axis == a || p.y_axis == a; });
}

void DetectionFeed::Read(const PeriodMeasurement& m) {
  last_bus_ = bus_;
  bus_ = m.bearings.front().bus;
  if (positions_.Read(m.reading_time, *m.readings, struck_)) WatchImpacts();
  for (std::size_t a = 0; a < start_.size(); ++a) {
    start_[a] = positions_.At(a, m.t);
    end_[a] = positions_.At(a, m.t + T_);
  }
  sensed_ = positions_.ready(m.t);
}

MeasuredPeriod DetectionFeed::Period(std::size_t bearing, const PeriodMeasurement& m) const {
  const View& v = views_[bearing];
  const BearingMeasurement& b = m.bearings[bearing];
  MeasuredPeriod in;
  in.t = m.t;
  in.adc = b.adc;
  in.duty = b.duty;
  in.bus = 0.5 * (b.bus + last_bus_);
  Place(
      v, v.weights, [&](std::size_t axis) { return start_[axis]; }, &in.x0, &in.y0);
  Place(
      v, v.weights, [&](std::size_t axis) { return end_[axis]; }, &in.x1, &in.y1);
  in.angle0 = m.angle + m.speed * (m.t - m.reading_time);
  in.angle1 = in.angle0 + m.speed * T_;
  in.uncertainty = v.uncertainty;
  bool sensed = sensed_;
  for (std::size_t a = 0; a < axis_names_.size(); ++a)
    if (positions_.faulty(a) && Uses(v, a)) sensed = false;
  const double step =
      kBusStep * rig_->amplifier.bus_voltage + kBusNoise * rig_->amplifier.bus_noise;
  in.comparable = sensed && std::abs(b.bus - last_bus_) < step &&
                  in.bus > kLeastBus * rig_->amplifier.bus_voltage;
  return in;
}

std::vector<std::string> DetectionFeed::TakeFaultyAxes() {
  std::vector<std::string> names;
  for (const int axis : positions_.TakeNewFaults())
    names.push_back(axis_names_[static_cast<std::size_t>(axis)]);
  return names;
}

}  // namespace ambrig
