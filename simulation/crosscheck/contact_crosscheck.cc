#include "simulation/crosscheck/contact_crosscheck.h"

#include <fmt/format.h>

#include "rig/true_rig.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

/// Passes on to an OdeRotor and keeps its counts past the engine's life.
class CountedOdeRotor : public RotorStepper {
 public:
  CountedOdeRotor(const RotorModel& model, const OdeOptions& options, ContactCrosscheck& crosscheck)
      : rotor_(model, options), crosscheck_(crosscheck) {}
  void Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
            double dt) override {
    rotor_.Step(s, Q, stator_x, stator_y, dt);
    crosscheck_.ode_steps = rotor_.steps();
    crosscheck_.ode_warnings = rotor_.warnings();
  }

 private:
  OdeRotor rotor_;
  ContactCrosscheck& crosscheck_;
};

CrosscheckRun RunOnce(const RigParameters& rig, const Scenario& scenario,
                      const SimulateOptions& options) {
  RunResult result = Simulate(rig, scenario, options);
  CrosscheckRun run;
  const TrueRig plant(rig);  // the clearance that the rotor has
  run.paths = CentrePaths(*plant, result.record);
  run.figures = MakeDropFigures(*plant, result, run.paths);
  run.events = std::move(result.events);
  return run;
}

}  // namespace

ContactCrosscheck CrosscheckContact(const RigParameters& rig, const Scenario& scenario,
                                    const CrosscheckOptions& options) {
  if (scenario.start == StartState::kClamped)
    throw InputError(
        fmt::format("{}: the rotor is clamped, allowed: levitated, resting", scenario.file));
  ContactCrosscheck w;
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
