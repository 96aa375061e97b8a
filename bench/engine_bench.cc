// Complete engine beside the bare update loop, so that the ratio to the limit is seen in one run:
//   build/release/ambrig_bench --benchmark_filter='Engine|UpdateLoop'
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "actuators/magnetics/whole_lane_vector.h"
#include "effects/catalogue.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {
namespace {

constexpr double kSeconds = 2;     // simulated, with everything on
constexpr double kWarmUp = 0.25;   // before it, without detection [s]
constexpr double kOfCommand = 20;  // of a whole command [s]
enum Detector { kNone, kCoupled, kCommissioned };

std::string RigFile() {
  return std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml";
}

const RigParameters& Rig() {
  static const RigParameters rig = ReadRig(RigFile());
  return rig;
}

RigParameters RigWith(int detector) {
  RigParameters rig = Rig();
  rig.detection.kind = detector == kCoupled ? "coupled" : kCommissionedDetector;
  return rig;
}

std::string ScenarioText(const std::string& rig, double seconds) {
  return "rig = \"" + rig + "\"\nduration = " + std::to_string(seconds) +
         "\n[speed]\nprofile = [[0.0, 157.0]]\n";
}

Scenario Healthy(bool noise, bool detection, double seconds = kSeconds,
                 const RigParameters& rig = Rig()) {
  Scenario s = ReadScenarioText(ScenarioText("r", seconds), "bench", rig);
  s.noise = noise;
  s.fault_tolerant = detection;
  return s;
}

void Count(benchmark::State& state, double simulated, double coils) {
  state.counters["x_real_time"] = benchmark::Counter(
      simulated * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["ns_per_coil_sample"] =
      benchmark::Counter(simulated * 450e3 * coils * static_cast<double>(state.iterations()) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void Engine(benchmark::State& state) {
  const auto detector = static_cast<int>(state.range(1));
  const RigParameters rig = RigWith(detector);
  const Scenario scenario = Healthy(state.range(0) != 0, detector != kNone);
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(rig, scenario, {}));
  Count(state, kSeconds + kWarmUp, 20);
}
BENCHMARK(Engine)
    ->ArgNames({"noise", "detector"})
    ->Args({1, kCommissioned})
    ->Args({1, kCoupled})
    ->Args({1, kNone})
    ->Args({0, kNone})
    ->Unit(benchmark::kMillisecond);

/// Both radial bearings with one law of the iron, without noise and detection: the run of a fit.
void EngineWithIron(benchmark::State& state, const std::string& law) {
  RigParameters rig = Rig();
  for (const char* bearing : {"A", "B"}) {
    EffectInstance e = MakeInstance(EffectNamed(law), bearing);
    for (std::size_t k = 0; k < e.table.size(); ++k) e.values[k] = e.table[k].typical_lo;
    rig.effects.push_back(e);
  }
  const Scenario scenario = Healthy(false, false);
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(rig, scenario, {}));
  Count(state, kSeconds + kWarmUp, 20);
}
BENCHMARK_CAPTURE(EngineWithIron, reluctance, "iron-reluctance")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EngineWithIron, saturation, "saturation")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EngineWithIron, hysteresis, "hysteresis")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EngineWithIron, eddy_currents, "eddy-currents")->Unit(benchmark::kMillisecond);

/// A stator that is a network of poles, without noise and detection.
void EngineOfStator(benchmark::State& state, const std::string& name) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/stators/" + name + ".toml");
  const Scenario scenario = Healthy(false, false, kSeconds, rig);
  double coils = 0;
  for (const BearingParameters& b : rig.bearings) coils += b.coils();
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(rig, scenario, {}));
  Count(state, kSeconds + kWarmUp, coils);
}
BENCHMARK_CAPTURE(EngineOfStator, six_poles, "six_poles")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EngineOfStator, homopolar, "homopolar")->Unit(benchmark::kMillisecond);

/// Everything on, as on a machine without registers of eight doubles (but for the noise).
void EngineInHalves(benchmark::State& state) {
  whole_lanes = false;
  const Scenario scenario = Healthy(true, true);
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(Rig(), scenario, {}));
  whole_lanes = HasWholeLanes();
  Count(state, kSeconds + kWarmUp, 20);
}
BENCHMARK(EngineInHalves)->Unit(benchmark::kMillisecond);

/// 20 s with everything on: the engine alone, and all that a user's command does, which records at
/// 1 kHz.
void EngineOfCommand(benchmark::State& state) {
  const Scenario scenario = Healthy(true, true, kOfCommand);
  SimulateOptions options;
  options.record = false;
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(Rig(), scenario, options));
  Count(state, kOfCommand + kWarmUp, 20);
}
BENCHMARK(EngineOfCommand)->Unit(benchmark::kMillisecond);

void WholeCommand(benchmark::State& state) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ambrig-bench-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "run.toml") << ScenarioText(RigFile(), kOfCommand);
  const std::string command = std::string(AMBRIG_PROGRAM) + " run " +
                              (folder / "run.toml").string() +
                              " --rate 1000 --no-report --quiet --force --out " + folder.string();
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) state.SkipWithError("the command failed");
  std::filesystem::remove_all(folder);
  Count(state, kOfCommand + kWarmUp, 20);
}
BENCHMARK(WholeCommand)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// The bearings' fast path alone: the first radial bearing, or all of the rig (20 coils).
void UpdateLoop(benchmark::State& state) {
  Plant plant = BuildPlant(TrueRig(Rig()));
  VoltagePattern pattern;
  Lane currents;
  for (int j = 0; j < kLanes; ++j) {
    currents[j] = 2;
    pattern.t2[j] = 21e-6;
    pattern.gain[0][j] = pattern.gain[2][j] = -1;
    pattern.gain[1][j] = 1;
  }
  std::vector<StatorLanes::PeriodOfBearing> bearings;
  int coils = 0;
  for (BearingPlant& b : plant.bearings) {
    if (!bearings.empty() && state.range(0) == 1) break;
    b.lanes.SetStep(1 / 450e3);
    b.lanes.Settle(currents, 0, 0);
    bearings.push_back({&b.lanes, &pattern, 0, 0, 1e-8, 0});
    coils += b.lanes.coils;
  }
  for (auto _ : state) {
    StatorLanes::RunPeriods(bearings.data(), static_cast<int>(bearings.size()), 30, 18);
    benchmark::DoNotOptimize(plant.bearings[0].lanes.fx);
  }
  Count(state, 40e-6, coils);
}
BENCHMARK(UpdateLoop)->ArgName("bearings")->Arg(1)->Arg(3);

}  // namespace
}  // namespace ambrig
