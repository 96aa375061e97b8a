#include "simulation/switching/switching_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/continuous/equilibrium.h"
#include "simulation/sampled/start_state.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/lost_rotor.h"

namespace ambrig {

SwitchingEngine::SwitchingEngine(const RigParameters& rig, const Scenario& scenario,
                                 const EngineOptions& options)
    : rig_(TrueRig(rig)),
      nominal_(options.nominal ? *options.nominal : rig),
      scenario_(scenario),
      options_(options),
      plant_(BuildPlant(rig_)) {
  if (options_.commands) {
    commands_ = options_.commands;
  } else {
    own_commands_ = std::make_unique<CommandPlan>(rig_, scenario_);
    commands_ = own_commands_.get();
  }
  T_ = 1 / rig_.amplifier.switching_frequency;
  samples_ = rig_.samples_per_period();
  Require(options_.substeps >= 1 && samples_ * options_.substeps <= 160,
          "at most 160 steps in a period");
  h_ = T_ / samples_;
  M_ = rig_.periods_per_control();
  periods_ = static_cast<long long>(std::ceil(scenario_.duration / T_ - 1e-6));
  plant_.rotor.SetSpeed(scenario_.speed, scenario_.speed_free_from);
  for (const LoadSpec& l : scenario_.loads)
    plant_.rotor.AddLoad(l.z + (rig_.nominal_com_z - rig_.z_origin), l.fx, l.fy, l.fz, l.start,
                         l.stop);
  std::size_t axis = 0;
  int auxiliary = 0;
  for (std::size_t k = 0; k < rig_.bearings.size(); ++k) {
    const BearingParameters& p = rig_.bearings[k];
    BearingRun b;
    b.index = k;
    b.plant = &plant_.bearings[k];
    b.first_axis = axis;
    b.axes = p.Axes().size();
    axis += b.axes;
    if (p.auxiliary && p.kind == BearingKind::kRadial) b.auxiliary = auxiliary++;
    b.measurement = {samples_,
                     p.coils(),
                     scenario_.noise,
                     rig_.amplifier.quadrants < 3,
                     rig_.amplifier.current_noise,
                     Quantiser(rig_.amplifier.adc_bits, rig_.amplifier.adc_range)};
    for (const CurrentSensor& s : b.plant->current_sensor)
      if (s.gain != 1 || s.offset != 0) b.plain_sensors = false;
    b.plant->lanes.SetStep(h_ / options_.substeps);
    bearings_.push_back(std::move(b));
    control_.push_back(MakeBearingControl(rig_, nominal_, k, plant_.bearings[k].lanes));
  }
  noise_.emplace(scenario_.seed, CoilsOf(rig_), axis, samples_);
  loop_.emplace(nominal_, plant_, *commands_, *noise_, scenario_.noise);
  current_loops_.emplace(rig_.amplifier, *commands_);
  contacts_.emplace(plant_.rotor, scenario_, T_);
  if (options_.stepper) stepper_ = options_.stepper(plant_.rotor);
}

SwitchingEngine::~SwitchingEngine() = default;

RunResult SwitchingEngine::Run() {
  Start();
  if (options_.record) StartRecord();
  for (long long n = -warm_; n < periods_; ++n) {
    if ((n & 255) == 0) {
      if (options_.stop && options_.stop->load()) throw Interrupted();
      if (options_.progress)
        options_.progress(static_cast<double>(n + warm_) / static_cast<double>(periods_ + warm_));
    }
    Period(n);
  }
  Verdict();
  if (record_) result_.record = record_->Take();
  if (options_.supervisor) options_.supervisor->Finish(result_);
  return std::move(result_);
}

void SwitchingEngine::Start() {
  if (options_.forced) {
    StartForced();
  } else
    switch (scenario_.start) {
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
  plant_.rotor.SetSpin(motion_);
  for (BearingRun& b : bearings_) {
    b.MoveTo(plant_.rotor.Position(motion_, b.plant->plane));
    b.plant->lanes.Settle(control_[b.index].set_point, b.x, b.y);
    b.plant->lanes.Force(b.x, b.y, &b.fx, &b.fy);
    control_[b.index].feedback = control_[b.index].set_point;
    control_[b.index].commanded = control_[b.index].set_point;
  }
}

void SwitchingEngine::StartRecord() {
  RowSource source{plant_, motion_, *loop_, *noise_, control_, {}};
  for (const BearingRun& b : bearings_) source.bearings.push_back(&b);
  record_.emplace(rig_, scenario_, options_.record_rate, clamped_, source);
}

void SwitchingEngine::StartLevitated() {
  warm_ = std::llround((options_.warm_up < 0 ? kLevitatedWarmUp : options_.warm_up) / T_ / M_) * M_;
  motion_.t = -static_cast<double>(warm_) * T_;
  std::vector<double> force = WeightOverAxes(rig_);
  if (!rig_.modes.empty()) {  // a shaft that sags, put there straight, would ring for seconds
    const Equilibrium e = LevitatedEquilibrium(rig_, scenario_);
    if (e.usable()) {
      force = e.force;
      motion_.q = e.q;
    }
  }
  StartWithForces(rig_, force, plant_, control_, motion_);
  loop_->Hold(force);
}

void SwitchingEngine::StartClamped() {
  warm_ = std::llround((options_.warm_up < 0 ? kClampedWarmUp : options_.warm_up) / T_);
  clamped_ = true;
  controller_on_ = false;
  current_loops_->Follow(CurrentLoops::SetPoints::kOfTheScenario);
  motion_.t = -static_cast<double>(warm_) * T_;
  PlaceClamped(rig_, scenario_, motion_);
  for (const CommandPlan::Signal& s : commands_->current)
    control_[static_cast<std::size_t>(s.bearing)].set_point[s.index] += CommandPlan::At(s, 0);
  for (BearingRun& b : bearings_) HoldSetPoints(control_[b.index], b.plant->base_resistance);
}

void SwitchingEngine::StartResting() {
  warm_ = 0;
  current_loops_->SwitchOn();
  motion_.t = 0;
  plant_.rotor.Rest(motion_);
  SwitchOn(control_);
}

void SwitchingEngine::Period(long long n) {
  motion_.t = static_cast<double>(n) * T_;
  plant_.rotor.SetSpin(motion_);
  loop_->ReadSensors(motion_);
  if (options_.forced) FollowData(n);
  loop_->Apply(n, control_);
  if (n % M_ == 0) {
    loop_->Sample(n, motion_.t);
    if (controller_on_) loop_->Tick(n, motion_.Omega, control_);
  }
  current_loops_->Period(n, control_);
  for (BearingRun& b : bearings_) SetPatterns(b);
  if (record_) record_->AtPeriodStart(n);  // a row shows this period's duty
  RunMagnetics(n);
  Measure(n);
  if (record_) record_->AfterMeasurement(n);
  for (BearingRun& b : bearings_) control_[b.index].feedback = b.current.mean;
  MoveRotor(n);
  if (n >= 0 && options_.watch) Watch(n);
}

void SwitchingEngine::MoveRotor(long long n) {
  HeatCopper();
  for (BearingRun& b : bearings_) {
    b.x = b.x_next;
    b.y = b.y_next;
  }
  if (clamped_) return;
  const auto dof = static_cast<std::size_t>(plant_.rotor.dof());
  DofVector& Q = magnetic_force_;  // kept: only what moves is written
  std::fill_n(Q.begin(), dof, 0.0);
  double sx = 0, sy = 0;
  for (const BearingRun& b : bearings_) {
    b.plant->plane.AddForce(b.fx, b.fy, Q);
    if (b.plant->thrust) continue;
    sx += b.fx;
    sy += b.fy;
  }
  std::copy_n(motion_.v.begin(), dof, acceleration_.begin());
  if (stepper_)
    stepper_->Step(motion_, Q, sx, sy, T_);
  else
    plant_.rotor.Step(motion_, Q, sx, sy, T_);
  motion_.t = static_cast<double>(n + 1) * T_;
  if (options_.lost_after < kInfinity && plant_.rotor.NearContact(motion_, 0)) {
    touching_ += T_;
    if (touching_ > options_.lost_after)
      throw LostRotor(scenario_.name + ": the rotor is lost", motion_.t);
  }
  const double per_period = 1 / T_;
  for (std::size_t d = 0; d < dof; ++d)
    acceleration_[d] = (motion_.v[d] - acceleration_[d]) * per_period;
  for (BearingRun& b : bearings_) {
    b.MoveTo(plant_.rotor.Position(motion_, b.plant->plane));
    if (!std::isfinite(b.x) || !std::isfinite(b.y))
      throw LostRotor(fmt::format("{}: the motion diverged at t = {} s", scenario_.name, motion_.t),
                      motion_.t);
  }
}

void SwitchingEngine::HeatCopper() {
  for (BearingRun& b : bearings_) {
    CoilHeating& heat = b.plant->heating;
    if (heat.rise_per_watt <= 0 || motion_.t < 0) continue;
    StatorLanes& lanes = b.plant->lanes;
    for (int j = 0; j < lanes.coils; ++j) {
      double& dT = heat.dT[static_cast<std::size_t>(j)];
      const double power = lanes.resistance[j] * b.current.mean_square[j];
      dT += T_ / heat.time_constant * (heat.rise_per_watt * power - dT);
      lanes.resistance[j] = b.plant->base_resistance[j] * (1 + 0.00393 * dT);
    }
    lanes.SetStep(T_ / samples_ / options_.substeps);
  }
}

}  // namespace ambrig
