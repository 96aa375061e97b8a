#include "simulation/verdict/contact_witness.h"

#include <fmt/format.h>

#include "simulation/simulate.h"

namespace ambrig {

namespace {

/// Passes on to an OdeRotor and keeps its counts past the engine's life.
class CountedOdeRotor : public RotorStepper {
 public:
  CountedOdeRotor(const RotorModel& model, const OdeOptions& options, ContactWitness& witness)
      : rotor_(model, options), witness_(witness) {}
  void Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
            double dt) override {
    rotor_.Step(s, Q, stator_x, stator_y, dt);
    witness_.ode_steps = rotor_.steps();
    witness_.ode_warnings = rotor_.warnings();
  }

 private:
  OdeRotor rotor_;
  ContactWitness& witness_;
};

WitnessRun RunOnce(const RigParameters& rig, const Scenario& scenario,
                   const SimulateOptions& options) {
  RunResult result = Simulate(rig, scenario, options);
  WitnessRun run;
  const RigParameters plant = TrueRig(rig);  // the clearance that the rotor has
  run.paths = CentrePaths(plant, result.record);
  run.figures = MakeDropFigures(plant, result, run.paths);
  run.events = std::move(result.events);
  return run;
}

}  // namespace

ContactWitness WitnessContact(const RigParameters& rig, const Scenario& scenario,
                              const WitnessOptions& options) {
  if (scenario.start == StartState::kClamped)
    throw InputError(fmt::format(
        "{}: nothing moves in a clamped scenario, allowed: levitated, resting", scenario.file));
  ContactWitness w;
  int done = 0;
  SimulateOptions simulate;
  simulate.record_rate = rig.amplifier.switching_frequency;
  simulate.stop = options.stop;
  simulate.progress = [&](double f) {
    if (options.progress) options.progress((done + f) / (options.other_noise ? 3 : 2));
  };
  w.model = RunOnce(rig, scenario, simulate);
  ++done;
  if (options.other_noise) {
    Scenario other = scenario;
    other.seed = scenario.seed + 1;
    w.other_noise = RunOnce(rig, other, simulate);
    w.parted_noise = PartingTime(w.model.paths, w.other_noise.paths, kPartedShare);
    ++done;
  }
  simulate.stepper = [&](const RotorModel& model) {
    return std::make_unique<CountedOdeRotor>(model, options.ode, w);
  };
  w.ode = RunOnce(rig, scenario, simulate);
  w.parted_ode = PartingTime(w.model.paths, w.ode.paths, kPartedShare);
  return w;
}

}  // namespace ambrig
