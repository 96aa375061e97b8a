#include "simulation/sampled/sampled_data_loop.h"

#include <algorithm>
#include <cmath>

#include "core/base/index.h"
#include "rig/nominal_control.h"
#include "simulation/sampled/coil_spread.h"
#include "simulation/sampled/controller_setup.h"
#include "simulation/sampled/designed_maps.h"

namespace ambrig {

namespace {

Scenario WithNoise(Scenario s, bool noise) {
  s.noise = s.noise && noise;
  return s;
}

}  // namespace

SampledDataLoop::SampledDataLoop(const RigParameters& given, const Scenario& s,
                                 const SampledOptions& o)
    : true_rig(given),
      nominal(o.nominal ? *o.nominal : NominalRig(given)),
      as_drawn(!o.nominal && !HasCalibration(given)),
      scenario(WithNoise(s, o.noise)),
      options(o),
      plant(BuildPlant(true_rig)),
      own_commands_(o.commands ? nullptr : std::make_unique<CommandPlan>(*nominal, scenario)),
      commands_(o.commands ? o.commands : own_commands_.get()),
      current_loops_(nominal, *commands_) {
  T = 1 / rig.amplifier.switching_frequency;
  samples = rig.samples_per_period();
  h = T / samples;
  bus_samples.assign(static_cast<std::size_t>(samples), plant.bus.voltage);
  M = nominal->periods_per_control();
  periods = static_cast<long long>(std::ceil(scenario.duration / T - 1e-6));
  computing_ = static_cast<long long>(std::ceil(nominal->detection.computing_time / T - 1e-6));
  if (options.coil_spread) DrawCoilSpread(rig, &plant);
  plant.rotor.SetSpeed(scenario.speed, scenario.speed_free_from);
  std::size_t axes = 0;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    AddBearing(k, axes);
    axes += bearings.back().axes;
  }
  noise_.emplace(scenario.seed, CoilsOf(rig), axes, samples,
                 rig.amplifier.adc_jitter > 0 || rig.amplifier.edge_jitter > 0);
  loop_.emplace(nominal, plant, *commands_, *noise_, scenario.noise);
}

void SampledDataLoop::AddBearing(std::size_t k, std::size_t first_axis) {
  const BearingParameters& p = rig.bearings[k];
  SampledBearing b;
  b.index = k;
  b.plant = &plant.bearings[k];
  b.first_axis = first_axis;
  b.axes = p.Axes().size();
  b.measurement = {samples,
                   p.coils(),
                   scenario.noise,
                   rig.amplifier.quadrants < 3,
                   rig.amplifier.current_noise,
                   rig.amplifier.adc_jitter / h,
                   Quantiser(rig.amplifier.adc_bits, rig.amplifier.adc_range)};
  for (int j = 0; j < p.coils(); ++j) b.late_edge[j] = b.plant->bridge[AsSize(j)].late_edge;
  for (const CurrentSensor& s : b.plant->current_sensor)
    if (s.gain != 1 || s.offset != 0) b.plain_sensors = false;
  bearings.push_back(b);
  control.push_back(MakeBearingControl(nominal, k));
}

void SampledDataLoop::Look(const RunControl& watcher, long long n) const {
  if (watcher.stop && watcher.stop->load()) throw Interrupted();
  if (watcher.progress)
    watcher.progress(static_cast<double>(n + warm) / static_cast<double>(periods + warm));
}

void SampledDataLoop::UpdatePositions() {
  for (SampledBearing& b : bearings) {
    const PlanePoint p = plant.rotor.Position(motion, b.plant->plane);
    b.true_x = p.x;
    b.true_y = p.y;
  }
}

void SampledDataLoop::AtPeriodStart(long long n) {
  motion.t = static_cast<double>(n) * T;
  plant.rotor.SetSpin(motion);
  loop_->ReadSensors(motion);
  loop_->Apply(n, control);
  if (n % M == 0) {
    loop_->Sample(n, motion.t);
    if (controller_on_) loop_->Tick(n, control);
  }
  current_loops_.Period(n, control);
  MoveEdges(n);
  if (record_) record_->AtPeriodStart(n);  // a row shows this period's duty
}

void SampledDataLoop::MoveEdges(long long n) {
  const double jitter = scenario.noise ? rig.amplifier.edge_jitter : 0;
  if (jitter == 0) return;
  for (SampledBearing& b : bearings)
    for (int j = 0; j < b.measurement.coils; ++j)
      b.late_edge[j] = b.plant->bridge[AsSize(j)].late_edge + jitter * noise_->Edge(b.index, j, n);
}

CoilVoltage SampledDataLoop::PatternOf(const SampledBearing& b, int j, double current) const {
  BridgeImperfection bridge = b.plant->bridge[AsSize(j)];
  bridge.late_edge = b.late_edge[j];
  bridge.off = bridge.off || control[b.index].disabled[AsSize(j)];
  for (const auto& term : b.plant->voltage[AsSize(j)])
    bridge.voltage_offset +=
        term->Voltage({motion.t, current, plant.bus.voltage, b.true_x - b.plant->offset_x,
                       b.true_y - b.plant->offset_y, &motion});
  return plant.bridge.Pattern(control[b.index].duty[j], bridge, current);
}

void SampledDataLoop::Measure(long long n, SampledBearing& b, const Lane* truth) {
  if (scenario.noise) noise_->DrawCurrents(n);
  if (scenario.noise && instants_of_ != n)
    instants_.Set(b.measurement.samples, b.measurement.jitter, noise_->Instants());
  instants_of_ = n;
  MeasureCurrents(b.measurement, truth, b.plant->current_sensor.data(), b.plain_sensors,
                  {noise_->Currents(b.index), instants_}, b.adc, &b.current);
}

void SampledDataLoop::EndMeasurement(long long n) {
  if (record_) record_->AfterMeasurement(n);
  for (const SampledBearing& b : bearings) control[b.index].feedback = b.current.mean;
}

std::size_t SampledDataLoop::Supervise(long long n, RunResult& result) {
  if (!options.supervisor || n < 0) return 0;
  PeriodMeasurement& m = measurement_;
  m.period = n;
  m.t = static_cast<double>(n) * T;
  m.samples = samples;
  m.readings = &loop_->readings();
  m.reading_time = loop_->reading_time();
  m.speed = loop_->speed_reading();
  m.angle = loop_->angle_reading();
  m.position_loop = controller_on_;
  m.bearings.clear();
  // The bus at the period's end: the next one's first reading.
  const double bus =
      noise_->BusReading(plant.bus.voltage, scenario.noise ? rig.amplifier.bus_noise : 0, n + 1, 0);
  // A retuned controller goes by the maps: it takes over with the first that is replaced.
  for (const SampledBearing& b : bearings)
    m.bearings.push_back({b.adc, &control[b.index].duty, bus,
                          loop_->Mapped(b.index) || commands_->retuned.has_value()});
  supervision_.actions.clear();
  supervision_.events.clear();
  options.supervisor->AfterPeriod(m, control, supervision_);
  if (!supervision_.actions.empty())
    computed_.push_back({n + computing_, std::move(supervision_.actions)});
  for (RunEvent& e : supervision_.events)
    if (e.kind == "redistributed" || e.kind == "not_redistributed" || e.kind == "restored")
      e.t += static_cast<double>(computing_) * T;
  if (!computed_.empty()) CarryOut(n);
  result.events.insert(result.events.end(), supervision_.events.begin(), supervision_.events.end());
  return supervision_.events.size();
}

void SampledDataLoop::CarryOut(long long n) {
  bool redistributed = false;
  for (; !computed_.empty() && computed_.front().due <= n; computed_.pop_front())
    for (const ControlAction& action : computed_.front().actions) {
      Apply(action, control);
      if (const auto* change = std::get_if<ReplaceMap>(&action); change && commands_->retuned) {
        TakeIntoDesign(nominal, *change, &maps_);
        redistributed = true;
      }
    }
  // The instant of the event "redistributed", in the same order of additions.
  const auto delay = static_cast<double>(computing_) * T;
  if (redistributed) Retune(static_cast<double>(n - computing_) * T + T + delay);
}

void SampledDataLoop::Retune(double t) {
  const std::size_t k = *commands_->retuned;
  const ControllerParameters& c = k == 0 ? nominal->controller : nominal->other_controllers[k - 1];
  const std::string name = k == 0 ? "main" : c.name;
  try {
    loop_->TakeOver(MakeController(nominal, c, maps_));
    supervision_.events.push_back({t, "retuned", name, "", 0});
  } catch (const std::runtime_error&) {
    supervision_.events.push_back({t, "not_retuned", name, "", 0});
  }
}

void SampledDataLoop::ReadAhead(long long n) {
  motion.t = static_cast<double>(n) * T;
  plant.rotor.SetSpin(motion);
  loop_->ReadPositions(motion);
}

RowSource SampledDataLoop::ValueSource() {
  RowSource source{plant, motion, *loop_, *noise_, control, bus_samples, {}};
  for (const SampledBearing& b : bearings) source.bearings.push_back(&b);
  return source;
}

void SampledDataLoop::StartRecord() {
  record_.emplace(rig, scenario, options.record_rate, clamped,
                  RecordedPart{options.recorded_channels, options.recorded_rows, periods},
                  ValueSource());
}

}  // namespace ambrig
