#include "campaign/detector_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ambrig {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLeastShare = 1e-4;  // lower end of the area under a curve

/// The entry of a list with this name, made at its end when it is not there.
template <class T>
T& Named(std::vector<T>& list, std::string T::*name, const std::string& value) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const T& one) { return one.*name == value; });
  if (it != list.end()) return *it;
  list.emplace_back();
  list.back().*name = value;
  return list.back();
}

/// Counts until Finish turns them into shares of what is at a level or above.
void AddWindows(FalseAlarmCurve& c, const DetectorOutcome& o) {
  c.share.resize(kStatisticLevels);
  for (const auto& [level, count] : o.windows) {
    c.share[static_cast<std::size_t>(std::clamp(level, 0, kStatisticLevels - 1))] +=
        static_cast<double>(count);
    c.windows += count;
  }
}

void Finish(FalseAlarmCurve& c) {
  c.share.resize(kStatisticLevels);
  for (std::size_t k = c.share.size() - 1; k > 0; --k) c.share[k - 1] += c.share[k];
  for (double& s : c.share) s /= static_cast<double>(std::max(c.windows, 1L));
}

/// Largest level that each healthy plant came to, in any coil and window.
using PlantLevels = std::map<std::string, int>;

void AddPlantLevel(PlantLevels& levels, const DetectorStudyRow& row, const DetectorOutcome& o) {
  if (row.plant.empty() || o.windows.empty()) return;
  int& level = levels[row.plant];
  level = std::max(level, o.windows.rbegin()->first);
}

void CountPlants(const PlantLevels& levels, FalseAlarmCurve& c) {
  c.plants = levels.size();
  c.alarmed.assign(kStatisticLevels, 0);
  for (const auto& [plant, level] : levels)
    for (int k = 0; k <= std::min(level, kStatisticLevels - 1); ++k)
      ++c.alarmed[static_cast<std::size_t>(k)];
}

struct FaultOutcome {
  double first_period_end = 0;  // from the fault [s]
  const DetectorOutcome* outcome = nullptr;
};

const LevelReached* FirstAt(const std::vector<LevelReached>& list, int level) {
  for (const LevelReached& r : list)
    if (r.level >= level) return &r;
  return nullptr;
}

double UpperQuantile(const std::vector<double>& sorted, double q) {
  return sorted[static_cast<std::size_t>(std::ceil(q * static_cast<double>(sorted.size())) - 1)];
}

void Fill(FaultCurve& c, const std::vector<FaultOutcome>& faults, double T) {
  c.runs = static_cast<long>(faults.size());
  const auto n = static_cast<double>(faults.size());
  for (int level = 0; level < kStatisticLevels; ++level) {
    std::vector<double> delays;
    double detected = 0, named = 0;
    for (const FaultOutcome& f : faults) {
      const LevelReached* own = FirstAt(f.outcome->coil, level);
      const LevelReached* any = FirstAt(f.outcome->bearing, level);
      delays.push_back(own ? f.first_period_end + own->period * T : kNever);
      detected += own ? 1 : 0;
      named += any && any->right ? 1 : 0;
    }
    std::sort(delays.begin(), delays.end());
    c.detected.push_back(detected / n);
    c.named.push_back(named / n);
    c.median.push_back(UpperQuantile(delays, 0.5));
    c.late.push_back(UpperQuantile(delays, 0.95));
  }
}

/// Detected share at the lowest threshold whose false alarms are at most `share`.
double DetectedAt(const std::vector<double>& false_alarm, const FaultCurve& c, double share) {
  for (std::size_t k = 0; k < false_alarm.size(); ++k)
    if (false_alarm[k] <= share) return c.detected[k];
  return 0;
}

double Area(const FalseAlarmCurve& healthy, const FaultCurve& c) {
  constexpr int kSteps = 200;
  const double low =
      std::log10(std::max(kLeastShare, 1 / static_cast<double>(std::max(healthy.windows, 1L))));
  if (low >= 0) return 0;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k)
    sum += DetectedAt(healthy.share, c, std::pow(10.0, low * (1 - (k + 0.5) / kSteps)));
  return sum / kSteps;
}

void SummariseAtBudget(DetectorCurves& d, const DetectorStudy& study) {
  const auto within = [&](double share) { return share <= study.budget; };
  const auto it = std::find_if(d.all.share.begin(), d.all.share.end(), within);
  d.budget_level = static_cast<int>((it == d.all.share.end() ? it - 1 : it) - d.all.share.begin());
  const auto level = static_cast<std::size_t>(d.budget_level);
  for (FaultCurve& c : d.faults) {
    c.area = Area(d.all, c);
    d.score += c.detected[level] / static_cast<double>(d.faults.size());
    d.mean_delay +=
        std::min(c.median[level], study.trial.window) / static_cast<double>(d.faults.size());
  }
}

}  // namespace

std::vector<DetectorCurves> CurvesOf(const DetectorStudy& study, const Rows& rows) {
  const double T = 1 / study.faulty.rig.amplifier.switching_frequency;
  std::vector<DetectorStudyRow> parsed;
  for (const auto& [run, row] : rows)
    parsed.push_back(ParseDetectorStudyRow(row, study.detectors.size()));
  std::vector<DetectorCurves> out;
  for (std::size_t k = 0; k < study.detectors.size(); ++k) {
    const CoilDetectorKind& kind = study.detectors[k];
    DetectorCurves d;
    d.name = kind.name;
    d.unit = kind.unit;
    d.doc = kind.doc;
    d.documented = kind.threshold;
    d.all.scenario = "all";
    std::vector<std::pair<std::string, std::vector<FaultOutcome>>> faults;
    PlantLevels plants;
    for (const DetectorStudyRow& row : parsed) {
      if (row.outcomes.empty()) continue;  // could not be finished
      if (!row.faulty) {
        AddWindows(d.all, row.outcomes[k]);
        AddPlantLevel(plants, row, row.outcomes[k]);
        AddWindows(Named(d.scenarios, &FalseAlarmCurve::scenario, row.scenario), row.outcomes[k]);
        continue;
      }
      auto& list =
          Named(faults, &std::pair<std::string, std::vector<FaultOutcome>>::first, row.kind).second;
      list.push_back(
          {(std::floor(row.fault_time / T + 1e-6) + 1) * T - row.fault_time, &row.outcomes[k]});
    }
    Finish(d.all);
    CountPlants(plants, d.all);
    for (FalseAlarmCurve& c : d.scenarios) Finish(c);
    for (const auto& [name, list] : faults) {
      FaultCurve& c = Named(d.faults, &FaultCurve::kind, name);
      Fill(c, list, T);
    }
    SummariseAtBudget(d, study);
    out.push_back(std::move(d));
  }
  return out;
}

std::vector<std::size_t> Ranking(const std::vector<DetectorCurves>& curves) {
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (curves[a].score != curves[b].score) return curves[a].score > curves[b].score;
    return curves[a].mean_delay < curves[b].mean_delay;
  });
  return order;
}

}  // namespace ambrig
