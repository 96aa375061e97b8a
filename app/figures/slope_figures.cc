// The figures of fault detection, after those of the paper that the detector comes from (its
// section 4, figures 11 to 20): the same pictures, redrawn from a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/run_figures.h"
#include "app/figures/series.h"
#include "app/text/format.h"

namespace ambrig {
namespace {

std::vector<double> AfterFault(const std::vector<double>& t, const RunStages& stages) {
  std::vector<double> out(t);
  for (double& v : out) v = (v - stages.fault.value_or(0)) * 1e3;
  return out;
}

// The edges of an expected band and the slope share one unit, the measured slope's largest.
DisplayUnit SlopeUnit(const ReportSlope& s) {
  return ChooseUnit(std::max(LargestSize(s.slope), LargestSize(s.high)), "A/s");
}

void AddSlope(Figure& figure, int panel, const ReportSlope& s, const RunStages& stages,
              double factor, bool legend) {
  const std::vector<double> t = AfterFault(s.t, stages);
  AddBand(figure, panel, "expected of a healthy coil", t, Scaled(s.low, factor),
          Scaled(s.high, factor));
  for (auto it = figure.traces.end() - 2; it != figure.traces.end(); ++it)
    if (!legend) (*it)["showlegend"] = false;
  std::vector<double> in(s.slope), out(s.slope);
  for (std::size_t k = 0; k < s.slope.size(); ++k) {
    const bool inside = s.slope[k] >= s.low[k] && s.slope[k] <= s.high[k];
    (inside ? out[k] : in[k]) = std::nan("");
  }
  Style style;
  style.markers = true;
  style.size = 4;
  style.legend = legend;
  AddLine(figure, panel, "measured, inside", t, Scaled(in, factor), style);
  style.color = "@red";
  AddLine(figure, panel, "measured, outside", t, Scaled(out, factor), style);
}

}  // namespace

std::optional<Figure> StageFigure(const RunReportData& data, const RunStages& stages) {
  if (!stages.fault) return {};
  for (const ReportBearing& b : data.bearings)
    for (std::size_t j = 0; j < b.currents.size(); ++j) {
      if (fmt::format("{}{}", b.name, j + 1) != stages.coil) continue;
      Figure figure =
          MakeFigure(fmt::format("Current of the faulty coil {} in its stages: A normal, B faulty "
                                 "and not yet compensated, "
                                 "C fault-tolerant. (Paper: figures 12 and 17.)",
                                 stages.coil));
      std::vector<double> t = UniformTime(data.start, data.rate, b.currents[j].size());
      const double from = stages.window[0], to = stages.window[1];
      const auto first = std::ranges::lower_bound(t, from) - t.begin();
      const auto last = std::ranges::upper_bound(t, to) - t.begin();
      const std::vector<double> window(t.begin() + first, t.begin() + last);
      Style style;
      style.color = "@red";
      style.width = 2;
      style.legend = false;
      AddLine(figure, 0, stages.coil, AfterFault(window, stages),
              std::span(b.currents[j]).subspan(static_cast<std::size_t>(first), window.size()),
              style);
      const double c = stages.reaction ? (*stages.reaction - *stages.fault) * 1e3 : 0;
      const double a = (from - *stages.fault) * 1e3, z = (to - *stages.fault) * 1e3;
      AddRegion(figure, 0, a, 0, "A", "@blue/10");
      AddRegion(figure, 0, 0, stages.reaction ? c : z, "B", "@red/10");
      if (stages.reaction) AddRegion(figure, 0, c, z, "C", "@green/10");
      SetAxes(figure, 0, "time after the fault [ms]", "current of " + stages.coil + " [A]",
              std::array{a, z});
      AddMarks(figure, EventMarks(data, *stages.fault, 1e3), {a, z});
      return figure;
    }
  return {};
}

Figure SampleFigure(const RunReportData& data) {
  Grid grid;
  grid.columns = std::min(3, static_cast<int>(data.samples.size()));
  grid.rows = (static_cast<int>(data.samples.size()) + grid.columns - 1) / grid.columns;
  grid.shared_x = false;
  grid.panel_height = 260;
  for (const ReportSamples& s : data.samples) grid.titles.push_back(s.coil + ", " + s.stage);
  Figure figure = MakeFigure(
      "Samples of the current converter during a few switching periods: the slope is fitted to "
      "them. "
      "A healthy coil rises and falls in straight lines; an open one carries nothing; a partly "
      "shorted one is steeper. (Paper: figures 13 and 18.)",
      grid);
  for (int p = 0; p < static_cast<int>(data.samples.size()); ++p) {
    const ReportSamples& s = data.samples[static_cast<std::size_t>(p)];
    std::vector<double> t(s.t);
    for (double& v : t) v = (v - s.t.front()) * 1e6;
    Style line;
    line.color = "@muted";
    line.width = 0.8;
    line.legend = false;
    AddLine(figure, p, s.stage + " line", t, s.i, line);
    figure.traces.back()["hoverinfo"] = "skip";
    Style points;
    points.markers = true;
    points.legend = false;
    AddLine(figure, p, s.stage, t, s.i, points);
    SetAxes(figure, p, fmt::format("time after t = {} s [µs]", FormatNumber(s.t.front(), 7)),
            "current [A]");
    if (LargestSize(s.i) < 0.02)  // nothing but noise: not blown up to look like a signal
      SetAxes(figure, p, fmt::format("time after t = {} s [µs]", FormatNumber(s.t.front(), 7)),
              "current [A]", {}, std::array{-0.1, 0.5});
  }
  return figure;
}

Figure SlopeFigure(const ReportSlope& s, const RunReportData& data, const RunStages& stages) {
  Grid grid;
  grid.rows = s.flag.empty() ? 1 : 2;
  grid.panel_height = s.flag.empty() ? 320 : 210;
  Figure figure = MakeFigure(
      fmt::format(
          "Slope of the current of {} in every switching period, against the band expected of "
          "a healthy coil at this position, voltage and current. {}(Paper: figures 14, 15, "
          "19 and 20.)",
          s.coil, s.flag.empty() ? "" : "Below, the detector's flag: 1 from its alarm on. "),
      grid);
  const DisplayUnit unit = SlopeUnit(s);
  AddSlope(figure, 0, s, stages, unit.factor, true);
  const std::vector<double> t = AfterFault(s.t, stages);
  const std::array<double, 2> range = {t.front(), t.back()};
  const std::string x = stages.fault ? "time after the fault [ms]" : "time [ms]";
  SetAxes(figure, 0, x, fmt::format("slope [{}]", unit.name), range);
  if (!s.flag.empty()) {
    Style style;
    style.color = "@red";
    style.width = 2;
    style.steps = true;
    style.legend = false;
    AddLine(figure, 1, "flag", t, s.flag, style);
    SetAxes(figure, 1, x, "fault flag [-]", range, std::array{-0.15, 1.15});
  }
  AddMarks(figure, EventMarks(data, stages.fault.value_or(0), 1e3), range);
  return figure;
}

std::optional<Figure> SlopeHistogram(const ReportSlope& s, const RunStages& stages) {
  std::vector<double> error;
  for (std::size_t k = 0; k < s.t.size(); ++k)
    if (!stages.fault || s.t[k] < *stages.fault)
      error.push_back(s.slope[k] - 0.5 * (s.low[k] + s.high[k]));
  std::erase_if(error, [](double e) { return !std::isfinite(e); });
  if (error.size() < 30) return {};
  Figure figure = MakeFigure(
      fmt::format("Deviation of the measured slope of {} from the middle of its expected band "
                  "while the coil is healthy: {} periods. The band must be wider than this "
                  "distribution, and a fault must lie outside the band. (Paper: figure 11.)",
                  s.coil, error.size()));
  figure.narrow = 640;
  const int bins =
      std::clamp(static_cast<int>(std::sqrt(static_cast<double>(error.size()))), 8, 60);
  const DisplayUnit unit = ChooseUnit(LargestSize(error), "A/s");
  AddHistogram(figure, 0, s.coil, Scaled(error, unit.factor), bins);
  figure.traces.back()["showlegend"] = false;
  SetAxes(figure, 0, fmt::format("slope minus expectation [{}]", unit.name),
          "switching periods [-]");
  return figure;
}

Figure SlopeGrid(const RunReportData& data, const RunStages& stages) {
  Grid grid;
  grid.columns = 4;
  grid.rows = (static_cast<int>(data.slopes.size()) + 3) / 4;
  grid.panel_height = 130;
  grid.shared_x = false;
  for (const ReportSlope& s : data.slopes) grid.titles.push_back(s.coil);
  Figure figure = MakeFigure(
      "Slopes of all coils against their expected bands. In a coupled stator one fault moves the "
      "slopes of healthy coils too; the expectation follows, so only the faulty coil leaves its "
      "band.",
      grid);
  const DisplayUnit unit = SlopeUnit(data.slopes.front());
  std::array<double, 2> range{};
  for (int p = 0; p < static_cast<int>(data.slopes.size()); ++p) {
    const ReportSlope& s = data.slopes[static_cast<std::size_t>(p)];
    AddSlope(figure, p, s, stages, unit.factor, p == 0);
    range = {(s.t.front() - stages.fault.value_or(0)) * 1e3,
             (s.t.back() - stages.fault.value_or(0)) * 1e3};
    const bool bottom = p + 4 >= static_cast<int>(data.slopes.size());
    SetAxes(figure, p, bottom ? "time [ms]" : "", p % 4 == 0 ? "[" + unit.name + "]" : "", range);
  }
  for (int p = static_cast<int>(data.slopes.size()); p < figure.panels; ++p)
    for (const char c : {'x', 'y'})
      figure.layout[fmt::format("{}axis{}", c, p + 1)]["visible"] = false;
  return figure;
}

}  // namespace ambrig
