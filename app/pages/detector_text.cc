/// A detector study for the terminal and for programs.
#include <fmt/format.h>

#include <cmath>

#include "app/json/json_number.h"
#include "app/pages/detector_report.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

std::size_t Unfinished(const Rows& rows) {
  std::size_t n = 0;
  for (const auto& [run, row] : rows) n += row.csv.ends_with(',') ? 0 : 1;
  return n;
}

std::string Delay(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  return seconds < 0.9995e-3 ? fmt::format("{:.0f} us", seconds * 1e6)
                             : fmt::format("{:.1f} ms", seconds * 1e3);
}

constexpr std::size_t kKindsBesideThreshold = 2, kKindsAlone = 3;  // that 80 columns hold

/// Kinds [first, last) of one detector at a level: share detected and median delay.
std::string RowOfCells(const DetectorCurves& d, std::size_t level, std::size_t first,
                       std::size_t last) {
  std::string text;
  for (std::size_t k = first; k < last; ++k)
    text += fmt::format("{:>16}", fmt::format("{:.1f} % {:>7}", 100 * d.faults[k].detected[level],
                                              Delay(d.faults[k].median[level])));
  return text;
}

/// One line a detector, one column a kind: detected share and median delay at a level of each; as
/// many tables below each other as it takes to stay within 80 columns.
template <class LevelOfDetector>
std::string Table(const std::vector<DetectorCurves>& curves, const std::vector<std::size_t>& order,
                  const LevelOfDetector& level_of) {
  const std::size_t kinds = curves.front().faults.size();
  std::string text;
  for (std::size_t first = 0; first < kinds;) {
    const std::size_t last =
        std::min(kinds, first + (first == 0 ? kKindsBesideThreshold : kKindsAlone));
    text += fmt::format("  {:<20}", "detector");
    if (first == 0) text += fmt::format("{:>12}{:>12}", "threshold", "false al.");
    for (std::size_t k = first; k < last; ++k)
      text += fmt::format("{:>16}", fmt::format("[{}]", k + 1));
    text += '\n';
    for (const std::size_t i : order) {
      const DetectorCurves& d = curves[i];
      const int level = level_of(d);
      if (level < 0) continue;
      const auto at = static_cast<std::size_t>(level);
      text += fmt::format("  {:<20}", d.name);
      if (first == 0)
        text += fmt::format("{:>12}{:>12.2e}",
                            fmt::format("{:.4g}{}", ValueOf(level), d.unit == "A" ? " A" : ""),
                            d.all.share[at]);
      text += RowOfCells(d, at, first, last) + '\n';
    }
    first = last;
  }
  return text;
}

/// Of how many healthy plants a detector raises an alarm, at its budget's and at its own threshold.
std::string PlantAlarms(const std::vector<DetectorCurves>& curves) {
  std::string text =
      fmt::format("healthy plants, of {}, with an alarm\n  {:<20}{:>20}{:>16}\n",
                  curves.front().all.plants, "detector", "threshold above", "its own");
  for (const std::size_t i : Ranking(curves)) {
    const DetectorCurves& d = curves[i];
    const auto at = [&](int level) {
      return std::to_string(d.all.alarmed[static_cast<std::size_t>(level)]);
    };
    text += fmt::format("  {:<20}{:>20}{:>16}\n", d.name, at(d.budget_level),
                        std::isnan(d.documented) ? "-" : at(LevelAtLeast(d.documented)));
  }
  return text;
}

Json FaultJson(const FaultCurve& c, std::size_t level) {
  return {{"kind", c.kind},
          {"runs", c.runs},
          {"detected", c.detected[level]},
          {"median_delay", FiniteOrNull(c.median[level])},
          {"delay_95", FiniteOrNull(c.late[level])},
          {"named", c.named[level]},
          {"area", c.area}};
}

/// Levels at which something changes, so that the file stays small.
Json CurveJson(const DetectorCurves& d) {
  Json out = Json::array();
  for (std::size_t k = 0; k < d.all.share.size(); ++k) {
    const bool same = k > 0 && k + 1 < d.all.share.size() && d.all.share[k] == d.all.share[k - 1] &&
                      std::all_of(d.faults.begin(), d.faults.end(), [&](const FaultCurve& c) {
                        return c.detected[k] == c.detected[k - 1] &&
                               c.median[k] == c.median[k - 1] && c.named[k] == c.named[k - 1];
                      });
    if (same) continue;
    Json detected = Json::array(), median = Json::array(), named = Json::array();
    for (const FaultCurve& c : d.faults) {
      detected.push_back(c.detected[k]);
      median.push_back(FiniteOrNull(c.median[k]));
      named.push_back(c.named[k]);
    }
    out.push_back({{"threshold", ValueOf(static_cast<int>(k))},
                   {"false_alarms", d.all.share[k]},
                   {"detected", detected},
                   {"median_delay", median},
                   {"named", named}});
  }
  return out;
}

}  // namespace

std::string DetectorText(const DetectorStudy& study, const std::vector<DetectorCurves>& curves,
                         const Rows& rows) {
  const DetectorCurves& first = curves.front();
  std::string text = fmt::format(
      "{}: {} of {}, {} of {:.3g} ms\n", study.name, rows.size(), Counted(study.runs(), "run"),
      Counted(first.all.windows, "healthy window"), study.trial.window * 1e3);
  if (const std::size_t n = Unfinished(rows); n > 0)
    text += fmt::format("  {} could not be finished (column note)\n", Counted(n, "run"));
  if (first.all.windows == 0 || first.faults.empty()) return text + "  nothing to compare\n";
  for (std::size_t k = 0; k < first.faults.size(); ++k)
    text += fmt::format("  [{}] {} ({})\n", k + 1, first.faults[k].kind,
                        Counted(first.faults[k].runs, "run"));
  text += fmt::format(
      "at most {:.3g} false alarms (false al.) per coil and window; share detected within\n"
      "one window and median delay; best first\n",
      study.budget);
  text += Table(curves, Ranking(curves), [](const DetectorCurves& d) { return d.budget_level; });
  text += "at the thresholds of their sources\n";
  text += Table(curves, Ranking(curves), [](const DetectorCurves& d) {
    return std::isnan(d.documented) ? -1 : LevelAtLeast(d.documented);
  });
  if (first.all.plants > 0) text += PlantAlarms(curves);
  return text;
}

nlohmann::ordered_json DetectorJson(const DetectorStudy& study,
                                    const std::vector<DetectorCurves>& curves, const Rows& rows) {
  Json detectors = Json::array();
  for (const std::size_t i : Ranking(curves)) {
    const DetectorCurves& d = curves[i];
    const auto level = static_cast<std::size_t>(d.budget_level);
    Json faults = Json::array(), healthy = Json::array();
    for (const FaultCurve& c : d.faults) faults.push_back(FaultJson(c, level));
    const std::size_t alarmed = d.all.plants > 0 ? d.all.alarmed[level] : 0;
    for (const FalseAlarmCurve& c : d.scenarios)
      healthy.push_back(
          {{"scenario", c.scenario}, {"windows", c.windows}, {"false_alarms", c.share[level]}});
    detectors.push_back({{"name", d.name},
                         {"unit", d.unit},
                         {"documented_threshold", FiniteOrNull(d.documented)},
                         {"threshold", ValueOf(d.budget_level)},
                         {"false_alarms", d.all.share[level]},
                         {"score", d.score},
                         {"mean_delay", d.mean_delay},
                         {"plants", d.all.plants},
                         {"plants_with_alarm", alarmed},
                         {"faults", faults},
                         {"healthy", healthy},
                         {"curve", CurveJson(d)}});
  }
  return {{"name", study.name},
          {"fingerprint", study.fingerprint},
          {"runs", study.runs()},
          {"done", rows.size()},
          {"unfinished", Unfinished(rows)},
          {"windows", curves.front().all.windows},
          {"window", study.trial.window},
          {"budget", study.budget},
          {"detectors", detectors}};
}

}  // namespace ambrig
