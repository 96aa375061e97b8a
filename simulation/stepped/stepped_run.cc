#include "simulation/stepped/stepped_run.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/index.h"
#include "simulation/run_supervisor.h"

namespace ambrig {

namespace {
constexpr double kSpeedStep = 1e-6;   // [s] in which a given speed is reached
constexpr double kSpeedRamp = 1e4;    // [s] over which an acceleration is written as one row
constexpr double kSameSpeed = 1e-12;  // relative
constexpr std::size_t kMostSpeedRows = 64;
}  // namespace

/// RotorModel::Step with the loads of the inputs.
struct SteppedRun::LoadedRotor : RotorStepper {
  LoadedRotor(SteppedRun& run_, const RotorModel& model) : run(run_), rotor(model) {}

  void Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
            double dt) override {
    const Plant& plant = run.engine_->loop().plant;
    const std::vector<PlanePoint>& load = run.inputs.load;
    bool any = false;
    for (const PlanePoint& f : load) any = any || f.x != 0 || f.y != 0;
    if (!any || !run.started_) return rotor.Step(s, Q, stator_x, stator_y, dt);
    DofVector all = Q;
    // Their mean over the step as RotorModel takes it of a scenario's loads, rounding included.
    const double share = (s.t + dt - s.t) / dt;
    for (std::size_t k = 0; k < load.size(); ++k) {
      const std::size_t bearings = plant.bearings.size();
      const PlaneMap& plane =
          k < bearings ? plant.bearings[k].plane : plant.stations[k - bearings].second;
      plane.AddForce(share * load[k].x, share * load[k].y, all);
    }
    rotor.Step(s, all, stator_x, stator_y, dt);
  }

  SteppedRun& run;
  const RotorModel& rotor;
};

SteppedRun::SteppedRun(const RigParameters& rig, const Scenario& scenario)
    : rig_(rig),
      scenario_(scenario),
      plan_(*NominalRig(rig), scenario),
      supervisor_(SupervisorOf(rig, scenario, false).supervisor) {
  AddCommands();
  EngineOptions options;
  options.record = false;
  options.commands = &plan_;
  options.supervisor = supervisor_.get();
  options.stepper = [this](const RotorModel& model) {
    return std::make_unique<LoadedRotor>(*this, model);
  };
  engine_ = std::make_unique<SwitchingEngine>(rig_, scenario_, options);
  const SampledDataLoop& loop = engine_->loop();
  inputs.load.assign(loop.plant.bearings.size() + loop.plant.stations.size(), {});
  values_ = std::make_unique<ChannelValues>(loop.rig, loop.scenario, engine_->loop().ValueSource());
  ListOutputs();
}

SteppedRun::~SteppedRun() = default;

void SteppedRun::AddCommands() {
  const std::size_t axes = AxisNames(rig_).size();
  inputs.reference.assign(axes, 0.0);
  inputs.force.assign(axes, 0.0);
  inputs.current.assign(rig_.bearings.size(), Lane{});
  first_reference_ = plan_.reference.size();
  first_force_ = plan_.force.size();
  first_current_ = plan_.current.size();
  for (std::size_t a = 0; a < axes; ++a) {
    plan_.reference.push_back({static_cast<int>(a), -1, {0.0}});
    plan_.force.push_back({static_cast<int>(a), -1, {0.0}});
  }
  for (std::size_t b = 0; b < rig_.bearings.size(); ++b)
    for (int j = 0; j < rig_.bearings[b].coils(); ++j)
      plan_.current.push_back({j, static_cast<int>(b), {0.0}});
}

void SteppedRun::ApplyInputs() {
  for (std::size_t a = 0; a < inputs.reference.size(); ++a) {
    plan_.reference[first_reference_ + a].values[0] = inputs.reference[a];
    plan_.force[first_force_ + a].values[0] = inputs.force[a];
  }
  for (std::size_t k = first_current_; k < plan_.current.size(); ++k) {
    CommandPlan::Signal& s = plan_.current[k];
    s.values[0] = inputs.current[AsSize(s.bearing)][s.index];
  }
}

void SteppedRun::ListOutputs() {
  for (const ChannelValues::Named& c :
       values_->Columns({ChannelKind::kCoilCurrent, ChannelKind::kSetPoint, ChannelKind::kDuty,
                         ChannelKind::kTruePosition, ChannelKind::kLoadCell},
                        true)) {
    SteppedOutput output;
    output.name = c.id.name();
    output.unit = std::string(c.id.row().unit);
    output.words = c.id.kind == ChannelKind::kLoadCell ? "force of the magnets, mean of a period"
                                                       : std::string(c.id.row().words);
    output.column = c.column;
    outputs_.push_back(output);
  }
  for (const auto kind : {SteppedOutput::Kind::kSlope, SteppedOutput::Kind::kInUse})
    for (std::size_t b = 0; b < rig_.bearings.size(); ++b)
      for (int j = 0; j < rig_.bearings[b].coils(); ++j) {
        const bool slope = kind == SteppedOutput::Kind::kSlope;
        outputs_.push_back(
            {fmt::format("{}.{}{}", rig_.bearings[b].name, slope ? "slope" : "in_use", j + 1),
             slope ? "A/s" : "-",
             slope ? "slope that the detector sees, 0 without fault tolerance"
                   : "the controller uses the coil",
             kind,
             {},
             b,
             j});
      }
  outputs_.push_back(
      {"contact", "-", "an auxiliary bearing is touched", SteppedOutput::Kind::kContact, {}, 0, 0});
}

void SteppedRun::SetSpeed(double speed, double acceleration) {
  RotorModel& rotor = engine_->loop().plant.rotor;
  const double t = static_cast<double>(n_) * T();
  if (!started_) {
    speed_rows_ = {{0.0, speed}};
    if (acceleration != 0) speed_rows_.push_back({kSpeedRamp, speed + acceleration * kSpeedRamp});
  } else {
    const SpeedProfile now = rotor.speed();
    const double before = now.Speed(t);
    if (speed_rows_.size() > kMostSpeedRows || speed_rows_.empty()) {
      // The same angle by one straight line.
      speed_rows_.clear();
      if (t > 0) speed_rows_.push_back({0.0, 2 * now.Angle(t) / t - before});
    }
    while (!speed_rows_.empty() && speed_rows_.back()[0] >= t) speed_rows_.pop_back();
    speed_rows_.push_back({t, before});
    double from = t;
    if (std::abs(speed - before) > kSameSpeed * std::abs(before)) {
      from = t + kSpeedStep;
      speed_rows_.push_back({from, speed});
    }
    if (acceleration != 0)
      speed_rows_.push_back({from + kSpeedRamp, speed + acceleration * kSpeedRamp});
  }
  rotor.SetSpeed(SpeedProfile(speed_rows_), scenario_.speed_free_from);
}

void SteppedRun::AddFault(FaultSpec fault) {
  fault.time = static_cast<double>(n_) * T();
  engine_->AddFault(fault);
}

void SteppedRun::Start() {
  ApplyInputs();
  engine_->Begin();
  for (long long n = -engine_->loop().warm; n < 0; ++n) engine_->Period(n);
  n_ = 0;
  started_ = true;
}

void SteppedRun::Period() {
  ApplyInputs();
  engine_->Period(n_++);
}

double SteppedRun::Value(const SteppedOutput& o) {
  switch (o.kind) {
    case SteppedOutput::Kind::kChannel:
      return values_->At(o.column, n_, true);
    case SteppedOutput::Kind::kSlope:
      return supervisor_ && n_ > 0 ? supervisor_->Band(o.bearing, o.coil).slope : 0;
    case SteppedOutput::Kind::kInUse:
      return engine_->loop().control[o.bearing].disabled[AsSize(o.coil)] ? 0 : 1;
    case SteppedOutput::Kind::kContact:
      break;
  }
  const SampledDataLoop& loop = engine_->loop();
  return loop.plant.rotor.NearContact(loop.motion, 0) ? 1 : 0;
}

void SteppedRun::Read(std::vector<double>& values) {
  engine_->loop().ReadAhead(n_);
  values.resize(outputs_.size());
  for (std::size_t k = 0; k < outputs_.size(); ++k) values[k] = Value(outputs_[k]);
}

}  // namespace ambrig
