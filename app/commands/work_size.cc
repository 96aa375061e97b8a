#include "app/commands/work_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "app/commands/run_size.h"
#include "core/base/counted.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

constexpr double kLongestWork = 24 * 3600;  // [s] of computing, without being told
constexpr double kWorthAWord = 60;          // [s]

// What the commissioning of a plant takes, in simulations as long as its run: nearly all of it is
// the fit.
constexpr double kRunsOfACommissioning = 20;
// Simulations of a record from the first fit to the verdict: 400 to 800 in cases of 6 or 7 records.
constexpr double kSimulationsPerRecord = 800;
// What such a simulation takes of a run with everything on: most have six samples a period, none
// noise or detection.
constexpr double kPartOfARun = 0.2;
// Columns beside the data while fitting: derivatives by every toleranced parameter and candidate.
constexpr double kColumnsOfAFit = 120;
constexpr double kMemoryOfRuns = 130e6;  // [bytes] predictions that are kept

unsigned Cores(int jobs) {
  return jobs > 0 ? static_cast<unsigned>(jobs) : std::max(1U, std::thread::hardware_concurrency());
}

/// Computing time [s] of the commissioning of all plants of a campaign that are commissioned.
double CommissioningSeconds(const Campaign& campaign) {
  const auto commissioned =
      std::count_if(campaign.plants.begin(), campaign.plants.end(),
                    [](const CampaignPlant& plant) { return plant.commissioned; });
  if (commissioned == 0) return 0;
  Scenario run = campaign.scenarios.front();
  run.duration = campaign.commissioning.duration;
  return static_cast<double>(commissioned) * kRunsOfACommissioning * RunSeconds(campaign.rig, run);
}

}  // namespace

WorkSize CampaignSize(const Campaign& campaign, std::size_t runs, int jobs) {
  WorkSize size;
  size.cores = Cores(jobs);
  for (const Scenario& s : campaign.scenarios) {
    size.seconds += RunSeconds(campaign.rig, s);
    size.bytes = std::max(size.bytes, RunMemory(campaign.rig, s, 0));
  }
  size.seconds *= static_cast<double>(runs) / static_cast<double>(campaign.scenarios.size());
  if (campaign.without) size.seconds *= 2;
  size.seconds += CommissioningSeconds(campaign) * static_cast<double>(runs) /
                  static_cast<double>(campaign.runs());
  size.seconds /= size.cores;
  size.bytes *= std::min<double>(size.cores, static_cast<double>(std::max<std::size_t>(runs, 1)));
  return size;
}

WorkSize ExplainSize(const Case& c) {
  WorkSize size;
  size.cores = Cores(0);
  double numbers = 0, record = 0;
  for (const CaseRecord& r : c.records) {
    size.seconds += RunSeconds(c.rig, r.scenario);
    record = std::max(record, RunMemory(c.rig, r.scenario, 0));
    numbers += static_cast<double>(r.data.rows() * r.data.channels.size());
  }
  size.seconds *= kSimulationsPerRecord * kPartOfARun / size.cores;
  size.bytes = numbers * sizeof(double) * kColumnsOfAFit + record * size.cores + kMemoryOfRuns;
  return size;
}

void CheckWorkSize(const std::string& file, const WorkSize& size, bool long_runs) {
  const double allowed = 0.9 * FreeMemory();
  if (size.bytes > allowed)
    throw InputError(fmt::format(
        "{}: needs about {:.1f} GB, allowed: {:.1f} GB of free memory (fewer rows or records, or "
        "fewer jobs)",
        file, size.bytes / 1e9, allowed / 1e9));
  if (size.seconds > kLongestWork && !long_runs)
    throw InputError(fmt::format(
        "{}: would take about {} on {}, allowed: {} unless --long is given", file,
        DurationText(size.seconds), Counted(size.cores, "core"), DurationText(kLongestWork)));
  if (size.seconds > kWorthAWord)
    fmt::print("{}: about {} on {}\n", file, DurationText(size.seconds),
               Counted(size.cores, "core"));
}

}  // namespace ambrig
