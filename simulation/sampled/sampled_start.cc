/// How a run begins, in every fidelity. What the controller holds at the start comes from the
/// nominal rig; where the shaft stands is the plant's. Source: docs/theory/engine.md.
#include <cmath>

#include "simulation/sampled/sampled_data_loop.h"
#include "simulation/sampled/start_state.h"

namespace ambrig {

void SampledDataLoop::Start() {
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
  FinishStart();
}

void SampledDataLoop::FinishStart() {
  plant.rotor.SetSpin(motion);
  plant.speed_sensor.Start(motion, scenario.seed);
  UpdatePositions();
  for (BearingControl& c : control) c.feedback = c.commanded = c.set_point;
}

void SampledDataLoop::HoldForces(const std::vector<double>& force) {
  const PlanePoint sum = StartWithForces(nominal, force, control);
  plant.rotor.SettleBase(motion, sum.x, sum.y);
  loop_->Hold(force);
}

void SampledDataLoop::StartLevitated() {
  warm = std::llround((options.warm_up < 0 ? kLevitatedWarmUp : options.warm_up) / T / M) * M;
  motion.t = -static_cast<double>(warm) * T;
  HoldForces(WeightOverAxes(*nominal));
  // A shaft that sags, put there straight, would ring for seconds.
  if (!rig.modes.empty()) StartInEquilibrium();
}

Equilibrium SampledDataLoop::StartInEquilibrium() {
  const Equilibrium e = LevitatedEquilibrium(rig, plant, control);
  if (!e.usable()) return e;
  motion.q = e.q;
  if (as_drawn) {
    HoldForces(e.force);
  } else {
    // The controller holds what its designer computes for the rig as drawn.
    const Plant as_designed = BuildPlant(TrueRig::AsDrawn(nominal));
    const Equilibrium drawn = LevitatedEquilibrium(*nominal, as_designed, control);
    HoldForces(drawn.usable() ? drawn.force : WeightOverAxes(*nominal));
  }
  FinishStart();
  return e;
}

void SampledDataLoop::StartClamped() {
  PrepareDriven(CurrentLoops::SetPoints::kOfTheScenario,
                options.warm_up < 0 ? kClampedWarmUp : options.warm_up);
  PlaceClamped(true_rig, scenario, motion);
  for (const CommandPlan::Signal& s : commands_->current)
    control[static_cast<std::size_t>(s.bearing)].set_point[s.index] += CommandPlan::At(s, 0);
  BeginUnderCurrent();
  HoldSetPoints(nominal, control);
}

void SampledDataLoop::BeginUnderCurrent() {
  for (const CommandPlan::StartCurrent& s : commands_->start)
    control[static_cast<std::size_t>(s.bearing)].set_point[s.index] = s.amperes;
}

void SampledDataLoop::PrepareDriven(CurrentLoops::SetPoints source, double warm_up) {
  warm = std::llround(warm_up / T);
  clamped = true;
  controller_on_ = false;
  current_loops_.Follow(source);
  motion.t = -static_cast<double>(warm) * T;
}

void SampledDataLoop::StartDriven() {
  BeginUnderCurrent();
  HoldSetPoints(nominal, control);
  FinishStart();
}

void SampledDataLoop::StartResting() {
  current_loops_.SwitchOn();
  motion.t = 0;
  plant.rotor.Rest(motion);
  SwitchOn(control);
}

}  // namespace ambrig
