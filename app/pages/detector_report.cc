#include "app/pages/detector_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "app/pages/html.h"
#include "app/text/format.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

std::string PercentText(double share) {
  return share == 1 || share == 0 ? fmt::format("{:.0f} %", 100 * share)
                                  : fmt::format("{:.1f} %", 100 * share);
}

/// "3.2 A"; a statistic in units of a source's own, "700 A/s", is so many times that.
std::string ThresholdText(double value, const std::string& unit) {
  if (unit.empty() || unit == "-") return fmt::format("{:.3g}", value);
  return fmt::format("{:.3g}{} {}", value,
                     std::isdigit(static_cast<unsigned char>(unit[0])) != 0 ? " ×" : "", unit);
}

Grid PanelPerKind(const std::vector<DetectorCurves>& curves) {
  Grid grid;
  grid.columns = 2;
  for (const FaultCurve& c : curves.front().faults) grid.titles.push_back(c.kind);
  grid.rows = static_cast<int>((grid.titles.size() + 1) / 2);
  grid.titles.resize(static_cast<std::size_t>(grid.rows * grid.columns));
  grid.panel_height = 230;
  return grid;
}

/// One line a detector in every panel; `y` of a fault's curve at a level. Points without false
/// alarms stand at half of one window.
template <class Value>
Figure CurveFigure(const std::string& caption, const std::vector<DetectorCurves>& curves,
                   const std::string& y_title, const Value& y) {
  Figure figure = MakeFigure(caption, PanelPerKind(curves));
  const auto kinds = static_cast<int>(curves.front().faults.size());
  const double none = 0.5 / static_cast<double>(std::max(curves.front().all.windows, 1L));
  for (int panel = 0; panel < kinds; ++panel) {
    const bool bottom = panel + 2 >= kinds;
    SetAxes(figure, panel, bottom ? "false alarms per coil and window" : "",
            panel % 2 == 0 ? y_title : "");
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const DetectorCurves& d = curves[i];
      const FaultCurve& c = d.faults[static_cast<std::size_t>(panel)];
      std::vector<double> xs, ys;
      for (std::size_t k = 0; k < d.all.share.size(); ++k) {
        const double value = y(c, k);
        if (!std::isfinite(value)) continue;
        xs.push_back(std::max(d.all.share[k], none));
        ys.push_back(value);
      }
      Style style = SeriesStyle(static_cast<int>(i));
      style.legend = panel == 0;
      AddLine(figure, panel, d.name, xs, ys, style);
    }
  }
  return figure;
}

void AtBudget(HtmlReport& report, const DetectorStudy& study,
              const std::vector<DetectorCurves>& curves) {
  report.Heading("At equal false alarms");
  report.Text(
      fmt::format("Each detector at the lowest threshold with at most {:.3g} false alarms per coil "
                  "and window of {}; best first. "
                  "A cell: share of the faults found within one window, median delay; and where it "
                  "is not the same share, in "
                  "brackets, how often the bearing's first alarm was the faulty coil's own.",
                  study.budget, FormatSi(study.trial.window, "s")));
  std::vector<std::string> columns = {"fault", "runs"};
  const auto order = Ranking(curves);
  for (const std::size_t i : order) columns.push_back(curves[i].name);
  std::vector<std::vector<Cell>> table;
  std::vector<Cell> thresholds = {Cell("threshold", "muted"), Cell("")};
  for (const std::size_t i : order)
    thresholds.emplace_back(ThresholdText(ValueOf(curves[i].budget_level), curves[i].unit),
                            "muted");
  table.push_back(thresholds);
  for (std::size_t k = 0; k < curves.front().faults.size(); ++k) {
    std::vector<Cell> line = {Cell(curves.front().faults[k].kind),
                              Cell(std::to_string(curves.front().faults[k].runs))};
    for (const std::size_t i : order) {
      const FaultCurve& c = curves[i].faults[k];
      const auto at = static_cast<std::size_t>(curves[i].budget_level);
      const double share = c.detected[at];
      std::string text = PercentText(share);
      if (std::isfinite(c.median[at])) text += ", " + FormatSi(c.median[at], "s");
      if (c.named[at] != share) text += " (" + PercentText(c.named[at]) + ")";
      line.emplace_back(text, share > 0.99 ? "ok" : share > 0.5 ? "warn" : "fail");
    }
    table.push_back(std::move(line));
  }
  report.Table(columns, table);
}

void OwnThresholds(HtmlReport& report, const std::vector<DetectorCurves>& curves) {
  report.Heading("False alarms at the thresholds of the sources");
  report.Text(
      "False alarms of the detectors whose source gives a threshold: share of healthy windows with "
      "an alarm, by running condition.");
  std::vector<std::string> columns = {"detector", "threshold"};
  for (const FalseAlarmCurve& c : curves.front().scenarios) columns.push_back(c.scenario);
  std::vector<std::vector<Cell>> table;
  for (const DetectorCurves& d : curves) {
    if (std::isnan(d.documented)) continue;
    std::vector<Cell> line = {Cell(d.name), Cell(ThresholdText(d.documented, d.unit))};
    for (const FalseAlarmCurve& c : d.scenarios) {
      const double share = c.share[static_cast<std::size_t>(LevelAtLeast(d.documented))];
      line.emplace_back(fmt::format("{} of {}", PercentText(share), c.windows),
                        share == 0 ? "ok" : "fail");
    }
    table.push_back(std::move(line));
  }
  report.Table(columns, table);
}

/// Mean share of the faults that is found at a level.
double FoundAt(const DetectorCurves& d, int level) {
  double sum = 0;
  for (const FaultCurve& c : d.faults) sum += c.detected[static_cast<std::size_t>(level)];
  return sum / static_cast<double>(d.faults.size());
}

/// Of the detectors whose source gives a threshold the one that alarms on the fewest healthy plants
/// there, of several the one that finds most faults; null: no source gives one.
const DetectorCurves* FewestPlants(const std::vector<DetectorCurves>& curves) {
  const auto rank = [](const DetectorCurves& d) {
    const int own = LevelAtLeast(d.documented);
    return std::pair(d.all.alarmed[static_cast<std::size_t>(own)], -FoundAt(d, own));
  };
  const DetectorCurves* best = nullptr;
  for (const DetectorCurves& d : curves)
    if (!std::isnan(d.documented) && (!best || rank(d) < rank(*best))) best = &d;
  return best;
}

void HealthyPlants(HtmlReport& report, const std::vector<DetectorCurves>& curves) {
  report.Heading("Healthy plants with an alarm");
  report.Text(
      "A plant counts once, however many of its windows have an alarm; at the threshold of the "
      "source, and the faults that are found there.");
  std::vector<std::string> columns = {"detector", "threshold", "healthy plants"};
  for (const FaultCurve& c : curves.front().faults) columns.push_back(c.kind);
  std::vector<std::vector<Cell>> table;
  for (const DetectorCurves& d : curves) {
    if (std::isnan(d.documented)) continue;
    const auto own = static_cast<std::size_t>(LevelAtLeast(d.documented));
    const std::size_t alarmed = d.all.alarmed[own];
    std::vector<Cell> line = {
        Cell(d.name), Cell(ThresholdText(d.documented, d.unit)),
        Cell(fmt::format("{} of {}", alarmed, d.all.plants), alarmed == 0 ? "ok" : "fail")};
    for (const FaultCurve& c : d.faults) line.emplace_back(PercentText(c.detected[own]));
    table.push_back(std::move(line));
  }
  report.Table(columns, table);
}

std::string VerdictText(const DetectorStudy& study, const std::vector<DetectorCurves>& curves) {
  const DetectorCurves& best = curves[Ranking(curves).front()];
  std::string text =
      fmt::format("Best at {:.3g} false alarms per coil and window: {}, {} of the faults found.",
                  study.budget, best.name, PercentText(best.score));
  const DetectorCurves* fewest = best.all.plants > 0 ? FewestPlants(curves) : nullptr;
  if (!fewest) return text;
  const int own = LevelAtLeast(fewest->documented);
  return fmt::format(
      "At the thresholds of their sources {} alarms on the fewest healthy plants, {} of {}, and "
      "finds {} of the faults. {}",
      fewest->name, fewest->all.alarmed[static_cast<std::size_t>(own)], fewest->all.plants,
      PercentText(FoundAt(*fewest, own)), text);
}

void Areas(HtmlReport& report, const std::vector<DetectorCurves>& curves) {
  std::vector<std::string> columns, rows;
  std::vector<std::vector<double>> values;
  for (const FaultCurve& c : curves.front().faults) columns.push_back(c.kind);
  for (const std::size_t i : Ranking(curves)) {
    rows.push_back(curves[i].name);
    values.emplace_back();
    for (const FaultCurve& c : curves[i].faults) values.back().push_back(c.area);
  }
  report.Text(
      "Area under the ROC curves over the logarithm of the false alarms: 1 = no error at any "
      "threshold, 0.1 = no better than chance.");
  report.Heatmap("Area under each curve above", columns, rows, values, "area");
}

}  // namespace

void WriteDetectorReport(const DetectorStudy& study, const std::vector<DetectorCurves>& curves,
                         const Rows& rows, const std::string& path) {
  HtmlReport report(study.name,
                    fmt::format("study of {} on {}, {}", Counted(curves.size(), "detector"),
                                Counted(study.runs(), "run"), study.fingerprint));
  if (curves.front().all.windows == 0 || curves.front().faults.empty()) {
    report.Verdict(Verdict::kFail, "No run was completed: there is nothing to compare.");
    report.Write(path);
    return;
  }
  const DetectorCurves& best = curves[Ranking(curves).front()];
  report.Verdict(Verdict::kInfo, VerdictText(study, curves));
  report.KeyValues({{"runs", fmt::format("{} of {}", rows.size(), study.runs())},
                    {"healthy windows of single coils", std::to_string(best.all.windows)},
                    {"window", FormatSi(study.trial.window, "s")}});
  std::vector<std::vector<Cell>> list;
  for (const DetectorCurves& d : curves) list.push_back({Cell(d.name), Cell(d.doc), Cell(d.unit)});
  report.Table({"detector", "what", "unit of its statistic"}, list);
  if (best.all.plants > 0) HealthyPlants(report, curves);
  AtBudget(report, study, curves);
  report.Heading("ROC curves");
  report.Text(
      "Share of faults found within one window against the share of healthy windows with a false "
      "alarm, threshold by threshold. "
      "No false alarm at all is drawn at half of one window.");
  Figure roc =
      CurveFigure("Detected faults against false alarms, per kind and size of fault.", curves,
                  "detected", [](const FaultCurve& c, std::size_t k) { return c.detected[k]; });
  for (int p = 0; p < static_cast<int>(curves.front().faults.size()); ++p)
    LogAxes(roc, p, true, false);
  report.AddFigure(roc);
  Areas(report, curves);
  report.Heading("Delay against false alarms");
  Figure delay = CurveFigure(
      "Median delay of detection against false alarms; a curve ends where fewer than half of the "
      "faults are found.",
      curves, "delay [µs]", [](const FaultCurve& c, std::size_t k) { return c.median[k] * 1e6; });
  for (int p = 0; p < static_cast<int>(curves.front().faults.size()); ++p)
    LogAxes(delay, p, true, true);
  report.AddFigure(delay);
  OwnThresholds(report, curves);
  report.Write(path);
}

}  // namespace ambrig
