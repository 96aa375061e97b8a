#include "simulation/sampled/sampled_rig.h"

#include <algorithm>
#include <cmath>

#include "simulation/continuous/equilibrium.h"
#include "simulation/sampled/start_state.h"

namespace ambrig {

namespace {
constexpr double kTiny = 1e-10;  // [s] instants equal to rounding

std::size_t U(int k) { return static_cast<std::size_t>(k); }

Scenario WithNoise(Scenario s, bool noise) {
  s.noise = s.noise && noise;
  return s;
}
}  // namespace

SampledRig::SampledRig(const RigParameters& given, const Scenario& s, const SampledOptions& o)
    : rig(TrueRig(given)),
      nominal(o.nominal ? *o.nominal : given),
      scenario(WithNoise(s, o.noise)),
      options(o),
      plant(BuildPlant(rig)),
      commands_(rig, scenario),
      current_loops_(rig.amplifier, commands_) {
  T = 1 / rig.amplifier.switching_frequency;
  samples = rig.samples_per_period();
  h = T / samples;
  M = rig.periods_per_control();
  periods = static_cast<long long>(std::ceil(scenario.duration / T - 1e-6));
  plant.rotor.SetSpeed(scenario.speed, scenario.speed_free_from);
  std::size_t axes = 0;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const BearingParameters& p = rig.bearings[k];
    ContinuousBearing b;
    b.index = k;
    b.plant = &plant.bearings[k];
    b.first_axis = axes;
    b.axes = p.Axes().size();
    b.measurement = {samples,
                     p.coils(),
                     scenario.noise,
                     rig.amplifier.quadrants < 3,
                     rig.amplifier.current_noise,
                     Quantiser(rig.amplifier.adc_bits, rig.amplifier.adc_range)};
    axes += b.axes;
    bearings.push_back(b);
    control.push_back(MakeBearingControl(rig, nominal, k, plant.bearings[k].lanes));
  }
  // the switching engine's, number by number
  noise_.emplace(scenario.seed, CoilsOf(rig), axes, samples);
  loop_.emplace(nominal, plant, commands_, *noise_, scenario.noise);
}

void SampledRig::Start() {
  switch (scenario.start) {
    case StartState::kLevitated:
      StartLevitated();
      break;
    case StartState::kClamped:
      StartClamped();
      break;
    case StartState::kResting:
      StartResting();
      break;
  }
  plant.rotor.SetSpin(motion);
  UpdatePositions();
  for (BearingControl& c : control) c.feedback = c.commanded = c.set_point;
}

void SampledRig::UpdatePositions() {
  for (SampledBearing& b : bearings) {
    const PlanePoint p = plant.rotor.Position(motion, b.plant->plane);
    b.true_x = p.x;
    b.true_y = p.y;
  }
}

void SampledRig::SetStartForces(const std::vector<double>& force) {
  StartWithForces(rig, force, plant, control, motion);
  loop_->Hold(force);
}

void SampledRig::StartLevitated() {
  warm = std::llround((options.warm_up < 0 ? kLevitatedWarmUp : options.warm_up) / T / M) * M;
  motion.t = -static_cast<double>(warm) * T;
  SetStartForces(WeightOverAxes(rig));
  if (rig.modes.empty()) return;
  // A shaft that sags, put there straight, would ring for seconds.
  const Equilibrium e = LevitatedEquilibrium(*this);
  if (e.usable()) StartFrom(e.force, e.q);
}

void SampledRig::StartFrom(const std::vector<double>& force, const DofVector& q) {
  SetStartForces(force);
  motion.q = q;
  UpdatePositions();
  for (BearingControl& c : control) c.feedback = c.commanded = c.set_point;
}

void SampledRig::StartClamped() {
  warm = std::llround((options.warm_up < 0 ? kClampedWarmUp : options.warm_up) / T);
  clamped = true;
  controller_on_ = false;
  current_loops_.Follow(CurrentLoops::SetPoints::kOfTheScenario);
  motion.t = -static_cast<double>(warm) * T;
  PlaceClamped(rig, scenario, motion);
  for (const CommandPlan::Signal& s : commands_.current)
    control[U(s.bearing)].set_point[s.index] += CommandPlan::At(s, 0);
  for (const SampledBearing& b : bearings)
    HoldSetPoints(control[b.index], b.plant->base_resistance);
}

void SampledRig::StartResting() {
  current_loops_.SwitchOn();
  motion.t = 0;
  plant.rotor.Rest(motion);
  SwitchOn(control);
}

void SampledRig::AtPeriodStart(long long n) {
  motion.t = static_cast<double>(n) * T;
  plant.rotor.SetSpin(motion);
  UpdatePositions();
  loop_->ReadSensors(motion);
  loop_->Apply(n, control);
  if (n % M == 0) {
    loop_->Sample(n, motion.t);
    if (controller_on_) loop_->Tick(n, motion.Omega, control);
  }
  current_loops_.Period(n, control);
  for (ContinuousBearing& b : bearings)
    for (int j = 0; j < control[b.index].coils; ++j) b.voltage[U(j)] = PatternOf(b, j);
  if (record_) record_->AtPeriodStart(n);
}

CoilVoltage SampledRig::PatternOf(const SampledBearing& b, int j) const {
  BridgeImperfection bridge = b.plant->bridge[U(j)];
  for (const auto& term : b.plant->voltage[U(j)])
    bridge.voltage_offset +=
        term->Voltage({motion.t, control[b.index].feedback[j], plant.bus.voltage,
                       b.true_x - b.plant->offset_x, b.true_y - b.plant->offset_y, &motion});
  return control[b.index].amplifier[U(j)].Pattern(control[b.index].duty[j], bridge);
}

void SampledRig::Measure(long long n, const std::vector<const Lane*>& truth, int count) {
  if (scenario.noise) noise_->DrawCurrents(n);
  for (SampledBearing& b : bearings) {
    MeasurementSettings settings = b.measurement;
    settings.samples = count;
    CurrentStatistics current;
    MeasureCurrents(settings, truth[b.index], b.plant->current_sensor.data(), false,
                    noise_->Currents(b.index), b.adc, &current);
    control[b.index].feedback = current.mean;
  }
}

}  // namespace ambrig
