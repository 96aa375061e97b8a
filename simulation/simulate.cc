#include "simulation/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "scenarios/expect_file.h"
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

constexpr std::pair<Fidelity, const char*> kFidelities[] = {{Fidelity::kSwitching, "switching"},
                                                            {Fidelity::kReference, "reference"},
                                                            {Fidelity::kAveraged, "averaged"}};

const char* NameOf(Fidelity fidelity) {
  return std::ranges::find(kFidelities, fidelity, [](const auto& f) { return f.first; })->second;
}

/// As WhyUnwatched, also for fidelities that have no supervisor.
std::string WhyUnwatched(const RigParameters& rig, const Scenario& scenario, Fidelity fidelity) {
  const std::string why = WhyUnwatched(rig, scenario);
  if (!why.empty() || fidelity == Fidelity::kSwitching) return why;
  return fmt::format("--fidelity {} has none", NameOf(fidelity));
}

/// The reader of the scenario has asked already, without the fidelity.
void CheckWatched(const Scenario& scenario, const std::string& why_unwatched) {
  const std::string_view key = scenario.expect.NeedsDetection();
  if (!scenario.fault_tolerant || key.empty() || why_unwatched.empty()) return;
  throw InputError(fmt::format(
      "{}: expect.{} asks for fault detection, which this run does not have: {}; allowed: "
      "--fidelity switching of a scenario that is watched, or without it",
      scenario.file.empty() ? scenario.name : scenario.file, key, why_unwatched));
}

/// Of a run that was to be watched; nobody misses a watch over coils that are held
/// still and healthy.
void NoteUnwatched(const Scenario& scenario, const std::string& why_unwatched, RunResult& result) {
  const bool held = scenario.start == StartState::kClamped && scenario.faults.empty();
  if (why_unwatched.empty() || !scenario.fault_tolerant || held) return;
  result.notes.push_back(fmt::format(
      "no fault detection in this run, so nothing is done about faults: {}", why_unwatched));
}

/// What a sampled command is where its file has no row.
void NoteUncovered(const Scenario& scenario, RunResult& result) {
  for (const Excitation& e : scenario.excitations) {
    if (e.kind != "samples") continue;
    const double row = 1 / e.sample_rate, to = std::min(e.stop, scenario.duration);
    if (e.sample_start > std::max(e.start, 0.0) + row)
      result.notes.push_back(
          fmt::format("the samples of {} begin at {:.6g} s: nothing is commanded before", e.target,
                      e.sample_start));
    if (e.SamplesEnd() < to - row)
      result.notes.push_back(
          fmt::format("the samples of {} end at {:.6g} s: their last value holds until {:.6g} s",
                      e.target, e.SamplesEnd(), to));
  }
}

RunResult RunSwitching(const RigParameters& rig, const Scenario& scenario,
                       const SimulateOptions& options, FaultSupervisor* supervisor) {
  EngineOptions engine;
  engine.record_rate = options.record_rate;
  engine.record = options.record;
  engine.snapshots = options.for_report;
  engine.stepper = options.stepper;
  engine.progress = options.progress;
  engine.stop = options.stop;
  engine.supervisor = supervisor;
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
        scenario.file, NameOf(options.fidelity), e.what()));
  }
}

}  // namespace

Fidelity FidelityByName(const std::string& name) {
  std::string all;
  for (const auto& [fidelity, its_name] : kFidelities) {
    if (name == its_name) return fidelity;
    all += fmt::format("{}{}", all.empty() ? "" : ", ", its_name);
  }
  throw InputError(fmt::format("--fidelity = {}, allowed: {}", name, all));
}

RunResult Simulate(const RigParameters& rig, const Scenario& scenario,
                   const SimulateOptions& options) {
  CheckControlled(rig, scenario);
  const std::string why_unwatched = WhyUnwatched(rig, scenario, options.fidelity);
  CheckWatched(scenario, why_unwatched);
  const auto begin = std::chrono::steady_clock::now();
  RunResult result;
  RunSupervisor watch;
  switch (options.fidelity) {
    case Fidelity::kSwitching:
      watch = SupervisorOf(rig, scenario, options.for_report);
      result = RunSwitching(rig, scenario, options, watch.supervisor.get());
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
  NoteUnwatched(scenario, why_unwatched, result);
  if (!watch.other_machine.empty()) result.notes.push_back(watch.other_machine);
  NoteUncovered(scenario, result);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.metrics.real_time_factor = wall > 0 ? scenario.duration / wall : 0;
  return result;
}

}  // namespace ambrig
