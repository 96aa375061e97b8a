// Complete engine beside the bare update loop, so that the ratio to the limit is seen in one run:
//   build/release/ambrig_bench --benchmark_filter='Engine|UpdateLoop'
#include <benchmark/benchmark.h>

#include "actuators/magnetics/whole_lane_vector.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {
namespace {

constexpr double kSeconds = 0.25;  // simulated, after as much warm-up

const RigParameters& Rig() {
  static const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  return rig;
}

Scenario Healthy(bool noise, bool detection) {
  Scenario s = ReadScenarioText("rig = \"r\"\nduration = 0.25\n[speed]\nprofile = [[0.0, 157.0]]\n",
                                "bench", Rig());
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
  const Scenario scenario = Healthy(state.range(0) != 0, state.range(1) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(Rig(), scenario, {}));
  Count(state, 2 * kSeconds, 20);
}
BENCHMARK(Engine)
    ->ArgNames({"noise", "detection"})
    ->Args({1, 1})
    ->Args({1, 0})
    ->Args({0, 0})
    ->Unit(benchmark::kMillisecond);

/// Everything on, as on a machine without registers of eight doubles (but for the noise).
void EngineInHalves(benchmark::State& state) {
  whole_lanes = false;
  const Scenario scenario = Healthy(true, true);
  for (auto _ : state) benchmark::DoNotOptimize(Simulate(Rig(), scenario, {}));
  whole_lanes = HasWholeLanes();
  Count(state, 2 * kSeconds, 20);
}
BENCHMARK(EngineInHalves)->Unit(benchmark::kMillisecond);

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
