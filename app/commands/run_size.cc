#include "app/commands/run_size.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/base/errors.h"
#include "simulation/sampled/start_state.h"

namespace ambrig {

namespace {

constexpr double kGiga = 1e9;         // [bytes]
constexpr double kLongestRun = 3600;  // [s] of computing, without being told

/// Of the machine, from its own account [bytes].
double AvailableMemory() {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);)
    if (double kilo = 0; std::sscanf(line.c_str(), "MemAvailable: %lf", &kilo) == 1)
      return kilo * 1024;
  return kInfinity;
}

/// What is simulated before t = 0, until the loop has settled [s].
double WarmUp(const Scenario& scenario) {
  switch (scenario.start) {
    case StartState::kLevitated:
      return kLevitatedWarmUp;
    case StartState::kClamped:
      return kClampedWarmUp;
    case StartState::kResting:
      break;
  }
  return 0;
}

/// Of the container, if it has a limit [bytes].
double ContainerMemory() {
  std::ifstream in("/sys/fs/cgroup/memory.max");
  double bytes = 0;
  return in >> bytes ? bytes : kInfinity;
}

}  // namespace

std::string DurationText(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60)
                        : fmt::format("{:.1f} h", seconds / 3600);
}

std::size_t RecordColumns(const RigParameters& rig, bool clamped) {
  std::size_t columns = 3;  // omega, theta, bus
  for (const BearingParameters& b : rig.bearings)
    columns += 2 * b.Axes().size() + 3 * static_cast<std::size_t>(b.coils());
  return columns + (clamped ? 0 : 2 * rig.stations.size());
}

double RunMemory(const RigParameters& rig, const Scenario& scenario, double rate) {
  const double rows = std::ceil(scenario.duration * (rate > 0 ? rate : scenario.record_rate)) + 1;
  const auto columns =
      static_cast<double>(RecordColumns(rig, scenario.start == StartState::kClamped));
  return 2 * rows * columns * sizeof(double);
}

double RunSeconds(const RigParameters& rig, const Scenario& scenario, Fidelity fidelity) {
  std::size_t coils = 0;
  for (const BearingParameters& b : rig.bearings) coils += static_cast<std::size_t>(b.coils());
  // The reference rig, 20 coils at 25 kHz with 18 samples a period, runs at six times real time.
  const double samples = rig.amplifier.switching_frequency * rig.samples_per_period();
  // Integrated with error control it takes ten times real time, with averaged voltages half of it.
  const double slow = fidelity == Fidelity::kReference  ? 60
                      : fidelity == Fidelity::kAveraged ? 3
                                                        : 1;
  return (scenario.duration + WarmUp(scenario)) * samples * (4 + static_cast<double>(coils)) *
         (slow / 6.0) / (25000.0 * 18 * 24);
}

double FreeMemory() {
  double free = std::min(AvailableMemory(), ContainerMemory());
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    free = std::min(free, static_cast<double>(limit.rlim_cur));
  return free;
}

void CheckRecordRate(const RigParameters& rig, double rate, const std::string& where) {
  const double pwm = rig.amplifier.switching_frequency, k = rig.samples_per_period();
  const double slow = pwm / rate, fast = rate / pwm;
  const auto whole = [](double v) { return std::abs(v - std::round(v)) < 1e-6 * v && v > 0.5; };
  if (whole(slow) || (whole(fast) && whole(k / fast))) return;
  throw InputError(
      fmt::format("{} = {} Hz, allowed: the switching frequency {} Hz over an integer, or times a "
                  "divisor of {} samples a period",
                  where, rate, pwm, k));
}

void CheckRunSize(const RigParameters& rig, const Scenario& scenario, double rate, bool long_runs,
                  Fidelity fidelity) {
  const double needed = RunMemory(rig, scenario, rate), allowed = 0.9 * FreeMemory();
  if (needed > allowed)
    throw InputError(fmt::format(
        "{}: the record would need {:.1f} GB, allowed: {:.1f} GB of free memory (a lower "
        "record_rate or a shorter duration)",
        scenario.file, needed / kGiga, allowed / kGiga));
  const double seconds = RunSeconds(rig, scenario, fidelity);
  if (seconds > kLongestRun && !long_runs)
    throw InputError(fmt::format(
        "{}: {} s of the rig, switched at {} Hz, would take about {}, allowed: {} unless "
        "--long is given",
        scenario.file, scenario.duration, rig.amplifier.switching_frequency, DurationText(seconds),
        DurationText(kLongestRun)));
}

}  // namespace ambrig
