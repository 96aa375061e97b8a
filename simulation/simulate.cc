#include "simulation/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/run_supervisor.h"
#include "simulation/switching/lost_rotor.h"
#include "simulation/switching/switching_engine.h"
#include "simulation/verdict/detection_score.h"
#include "simulation/verdict/stuck_switch.h"

namespace ambrig {

namespace {

void CheckControlled(const RigParameters& rig, const Scenario& scenario) {
  if (rig.controller.kind != "none" || scenario.start == StartState::kClamped) return;
  throw InputError(fmt::format(
      "{}: the rotor is free, but {} has no [controller], allowed: one, or [start] state = "
      "\"clamped\"",
      scenario.file.empty() ? scenario.name : scenario.file, rig.file));
}

RunResult RunSwitching(const RigParameters& rig, const Scenario& scenario,
                       const SimulateOptions& options) {
  EngineOptions engine;
  engine.record_rate = options.record_rate;
  engine.record = options.record;
  engine.snapshots = options.for_report;
  engine.stepper = options.stepper;
  engine.progress = options.progress;
  engine.stop = options.stop;
  const auto supervisor = SupervisorOf(rig, scenario, options.for_report);
  engine.supervisor = supervisor.get();
  return SwitchingEngine(rig, scenario, engine).Run();
}

/// The witnesses integrate continuously: no noise, no detection (their cost is in the equations).
template <class Options>
RunResult RunContinuous(const RigParameters& rig, const Scenario& scenario,
                        const SimulateOptions& options, Options o,
                        RunResult (*run)(const RigParameters&, const Scenario&, const Options&)) {
  o.sampled.record_rate = options.record_rate;
  o.progress = options.progress;
  o.stop = options.stop;
  try {
    return run(rig, scenario, o);
  } catch (const LostRotor&) {
    throw;
  } catch (const NoSolution& e) {
    throw NoSolution(fmt::format(
        "{}: the {} equations of this rig and scenario could not be integrated ({}); allowed: "
        "--fidelity switching, or numbers less extreme",
        scenario.file, options.fidelity == Fidelity::kReference ? "reference" : "averaged",
        e.what()));
  }
}

}  // namespace

Fidelity FidelityByName(const std::string& name) {
  if (name == "switching") return Fidelity::kSwitching;
  if (name == "reference") return Fidelity::kReference;
  if (name == "averaged") return Fidelity::kAveraged;
  throw InputError(fmt::format("--fidelity = {}, allowed: switching, reference, averaged", name));
}

RunResult Simulate(const RigParameters& rig, const Scenario& scenario,
                   const SimulateOptions& options) {
  CheckControlled(rig, scenario);
  const auto begin = std::chrono::steady_clock::now();
  RunResult result;
  switch (options.fidelity) {
    case Fidelity::kSwitching:
      result = RunSwitching(rig, scenario, options);
      break;
    case Fidelity::kReference:
      result = RunContinuous(rig, scenario, options, ReferenceOptions{}, RunReference);
      break;
    case Fidelity::kAveraged:
      result = RunContinuous(rig, scenario, options, DefaultAveragedOptions(), RunAveraged);
      break;
  }
  std::stable_sort(result.events.begin(), result.events.end(),
                   [](const RunEvent& a, const RunEvent& b) { return a.t < b.t; });
  ScoreDetection(scenario, result);
  NoteStuckSwitches(rig, scenario, result);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.metrics.real_time_factor = wall > 0 ? scenario.duration / wall : 0;
  return result;
}

}  // namespace ambrig
