#include "app/pages/design_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/pages/html.h"
#include "app/text/format.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

constexpr std::size_t kMostRows = 200, kMostPairs = 6;

Style StyleOf(std::size_t candidate) { return SeriesStyle(static_cast<int>(candidate)); }

std::string FigureValueText(const FigureSpec& f, double v) {
  if (!std::isfinite(v)) return "unstable";
  return f.info->unit == "-" ? FormatNumber(v) : FormatSi(v, f.info->unit);
}

std::string VariablesText(const DesignCandidate& c, const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k)
    text += fmt::format("{}{} = {}", k == 0 ? "" : ", ", c.variables[k].paths.front(),
                        FormatNumber(values[k], 4));
  return text.empty() ? "as in its file" : text;
}

/// Unit in which a figure is drawn.
DisplayUnit UnitOfFigure(const StudyResult& result, const Study& study, std::size_t figure) {
  double largest = 0;
  for (const StudyPoint& p : result.points)
    if (p.feasible) largest = std::max(largest, std::abs(p.result.figures[figure]));
  const std::string unit(study.figures[figure].info->unit);
  return unit == "-" ? DisplayUnit{1, "-"} : ChooseUnit(largest, unit);
}

void Summary(HtmlReport& report, const Study& study, const StudyResult& result,
             const std::vector<PointResponses>& shown) {
  // A line a figure, a column a candidate: figures are many, candidates few.
  std::vector<std::string> columns{"figure"};
  std::vector<std::vector<Cell>> rows{
      {"points"}, {"meet limits"}, {"on the front"}, {"point shown"}, {"its numbers"}};
  for (const FigureSpec& f : study.figures)
    rows.push_back(
        {f.name + (f.at_most ? fmt::format(" (at most {})", FigureValueText(f, *f.at_most)) : "")});
  for (std::size_t c = 0; c < study.candidates.size(); ++c) {
    columns.push_back(study.candidates[c].name);
    std::size_t all = 0, feasible = 0, front = 0;
    for (const StudyPoint& p : result.points) {
      if (p.candidate != c) continue;
      ++all;
      feasible += p.feasible ? 1 : 0;
      front += p.front ? 1 : 0;
    }
    const StudyPoint& p = result.points[shown[c].point];
    rows[0].emplace_back(std::to_string(all));
    rows[1].emplace_back(std::to_string(feasible));
    rows[2].emplace_back(std::to_string(front));
    rows[3].emplace_back(std::to_string(shown[c].point));
    rows[4].emplace_back(VariablesText(study.candidates[c], p.values));
    for (std::size_t k = 0; k < study.figures.size(); ++k) {
      const double value = p.result.figures[k];
      const bool bad =
          !std::isfinite(value) || (study.figures[k].at_most && value > *study.figures[k].at_most);
      rows[5 + k].emplace_back(FigureValueText(study.figures[k], value), bad ? "fail" : "");
    }
  }
  report.Heading("Comparison of the candidates");
  report.Text(
      "Of every candidate one point: on the Pareto front, where its largest objective over the "
      "first candidate's start is least. Figures are the worst "
      "over the nominal rig" +
      std::string(study.draws.size() > 1 ? fmt::format(" and {} of its parameters.",
                                                       Counted(study.draws.size() - 1, "draw"))
                                         : "."));
  report.Table(columns, rows);
}

void Scatter(HtmlReport& report, const Study& study, const StudyResult& result) {
  const auto objectives = study.Objectives();
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < objectives.size(); ++a)
    for (std::size_t b = a + 1; b < objectives.size() && pairs.size() < kMostPairs; ++b)
      pairs.emplace_back(objectives[a], objectives[b]);
  if (pairs.empty()) return;
  report.Heading("Pareto front");
  report.Text(
      "All feasible points; large markers are Pareto-optimal. Smaller is better on both axes.");
  Grid grid;
  grid.columns = pairs.size() > 1 ? 2 : 1;
  grid.rows = (static_cast<int>(pairs.size()) + grid.columns - 1) / grid.columns;
  grid.shared_x = false;
  grid.panel_height = 300;
  Figure figure = MakeFigure("Objectives against each other", grid);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    const DisplayUnit ux = UnitOfFigure(result, study, i), uy = UnitOfFigure(result, study, j);
    for (std::size_t c = 0; c < study.candidates.size(); ++c)
      for (const bool front : {false, true}) {
        std::vector<double> x, y;
        for (const StudyPoint& p : result.points)
          if (p.candidate == c && p.feasible && p.front == front) {
            x.push_back(ux.factor * p.result.figures[i]);
            y.push_back(uy.factor * p.result.figures[j]);
          }
        if (x.empty()) continue;
        Style style = StyleOf(c);
        style.markers = true;
        style.size = front ? 9 : 4;
        style.legend = k == 0;
        if (!front) style.color += "/50";
        AddLine(figure, static_cast<int>(k), study.candidates[c].name + (front ? ", front" : ""), x,
                y, style);
      }
    SetAxes(figure, static_cast<int>(k), fmt::format("{} [{}]", study.figures[i].name, ux.name),
            fmt::format("{} [{}]", study.figures[j].name, uy.name));
  }
  report.AddFigure(figure);
}

void ParallelCoordinates(HtmlReport& report, const Study& study, const StudyResult& result) {
  std::vector<std::size_t> shown;  // figures with a spread on the front
  std::vector<double> low, high;
  for (std::size_t k = 0; k < study.figures.size(); ++k) {
    double a = kInfinity, b = -kInfinity;
    for (const StudyPoint& p : result.points)
      if (p.front) {
        a = std::min(a, p.result.figures[k]);
        b = std::max(b, p.result.figures[k]);
      }
    if (!(b > a)) continue;
    shown.push_back(k);
    low.push_back(a);
    high.push_back(b);
  }
  if (shown.size() < 2) return;
  Figure figure = MakeFigure(
      "Pareto-optimal points, one line each: 0 is the least value on the front, 1 the largest");
  std::vector<bool> named(study.candidates.size(), false);
  for (const StudyPoint& p : result.points) {
    if (!p.front) continue;
    std::vector<double> x, y;
    for (std::size_t k = 0; k < shown.size(); ++k) {
      x.push_back(static_cast<double>(k));
      y.push_back((p.result.figures[shown[k]] - low[k]) / (high[k] - low[k]));
    }
    Style style = StyleOf(p.candidate);
    style.width = 1.2;
    style.legend = !named[p.candidate];
    named[p.candidate] = true;
    AddLine(figure, 0, study.candidates[p.candidate].name, x, y, style);
  }
  SetAxes(figure, 0, "", "share of the front's range [-]",
          std::array<double, 2>{-0.5, static_cast<double>(shown.size()) - 0.5},
          std::array<double, 2>{-0.05, 1.05});
  std::vector<std::string> names;
  std::vector<double> at;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const FigureSpec& f = study.figures[shown[k]];
    std::string name = HtmlEscape(f.name);  // in lines: many stand side by side
    for (std::size_t colon = 0; (colon = name.find(": ", colon)) != std::string::npos;)
      name.replace(colon, 2, ":<br>");
    names.push_back(fmt::format("{}<br>{} to<br>{}", name, FigureValueText(f, low[k]),
                                FigureValueText(f, high[k])));
    at.push_back(static_cast<double>(k));
  }
  figure.layout["xaxis"]["tickvals"] = at;
  figure.layout["xaxis"]["ticktext"] = names;
  figure.layout["xaxis"]["tickangle"] = 0;
  figure.layout["xaxis"]["automargin"] = true;
  report.AddFigure(figure);
}

/// Planes of the shaft that the study watches in this scenario.
void PlaneFigures(HtmlReport& report, const Study& study, const std::vector<PointResponses>& shown,
                  std::size_t s) {
  const std::size_t planes =
      shown.empty() || s >= shown[0].scenarios.size() ? 0 : shown[0].scenarios[s].planes.size();
  for (std::size_t p = 0; p < planes; ++p) {
    Figure figure =
        MakeFigure(fmt::format("{}: {}, distance from where it stood at the start",
                               study.scenarios[s].name, shown[0].scenarios[s].planes[p].first));
    for (std::size_t c = 0; c < shown.size(); ++c) {
      if (s >= shown[c].scenarios.size() || p >= shown[c].scenarios[s].planes.size()) continue;
      const ScenarioTrace& trace = shown[c].scenarios[s];
      AddLine(figure, 0, study.candidates[c].name, Scaled(trace.t, 1e3),
              Scaled(trace.planes[p].second, 1e6), StyleOf(c));
    }
    SetAxes(figure, 0, "time [ms]", "distance [µm]");
    report.AddFigure(figure);
  }
}

void Responses(HtmlReport& report, const Study& study, const std::vector<PointResponses>& shown) {
  report.Heading("Responses of the points shown");
  Figure linear = MakeFigure(
      "Linear loop: first axis after a unit load there; largest sensitivity over axes and speeds",
      {1, 2, false, {}, 320});
  for (std::size_t c = 0; c < shown.size(); ++c) {
    const PointResponses& r = shown[c];
    if (r.step.empty()) continue;
    AddLine(linear, 0, study.candidates[c].name, Scaled(r.step_t, 1e3), Scaled(r.step, 1e6),
            StyleOf(c));
    Style style = StyleOf(c);
    style.legend = false;
    AddLine(linear, 1, study.candidates[c].name, r.hertz, r.sensitivity, style);
  }
  SetAxes(linear, 0, "time [ms]", "reading per load [µm/N]");
  SetAxes(linear, 1, "frequency [Hz]", "|S| [-]");
  LogAxes(linear, 1, true, false);
  AddLevel(linear, 1, 3, "ISO 14839-3 A/B");
  report.AddFigure(linear);
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    Figure run =
        MakeFigure(fmt::format("{}: distance of the shaft from the centre, worst radial bearing",
                               study.scenarios[s].name));
    for (std::size_t c = 0; c < shown.size(); ++c)
      if (s < shown[c].scenarios.size())
        AddLine(run, 0, study.candidates[c].name, Scaled(shown[c].scenarios[s].t, 1e3),
                Scaled(shown[c].scenarios[s].orbit, 1e6), StyleOf(c));
    SetAxes(run, 0, "time [ms]", "orbit [µm]");
    report.AddFigure(run);
    PlaneFigures(report, study, shown, s);
  }
}

void FrontTable(HtmlReport& report, const Study& study, const StudyResult& result) {
  std::vector<std::string> columns{"point", "candidate", "numbers"};
  for (const FigureSpec& f : study.figures) columns.push_back(f.name);
  std::vector<std::vector<Cell>> rows;
  for (std::size_t k = 0; k < result.points.size() && rows.size() < kMostRows; ++k) {
    const StudyPoint& p = result.points[k];
    if (!p.front) continue;
    std::vector<Cell> row{std::to_string(k), study.candidates[p.candidate].name,
                          VariablesText(study.candidates[p.candidate], p.values)};
    for (std::size_t j = 0; j < study.figures.size(); ++j)
      row.emplace_back(FigureValueText(study.figures[j], p.result.figures[j]));
    rows.push_back(row);
  }
  report.Heading("Pareto-optimal points");
  report.Text(
      fmt::format("Rig, scenarios, records and reports of point N again: `ambrig design {} "
                  "--point N`.",
                  study.file));
  report.Table(columns, rows);
}

}  // namespace

void WriteDesignReport(const Study& study, const StudyResult& result,
                       const std::vector<PointResponses>& shown, const std::string& path) {
  const auto front = std::count_if(result.points.begin(), result.points.end(),
                                   [](const StudyPoint& p) { return p.front; });
  const auto feasible = std::count_if(result.points.begin(), result.points.end(),
                                      [](const StudyPoint& p) { return p.feasible; });
  HtmlReport report(
      study.name, fmt::format("design study, {}, {}", Counted(study.candidates.size(), "candidate"),
                              study.fingerprint));
  report.Verdict(
      front > 0 ? Verdict::kOk : Verdict::kFail,
      front > 0 ? fmt::format("{} of {} are feasible, {} are Pareto-optimal.", feasible,
                              Counted(result.points.size(), "point"), front)
                : fmt::format("None of {} is feasible.", Counted(result.points.size(), "point")));
  Summary(report, study, result, shown);
  if (front > 0) {
    Scatter(report, study, result);
    ParallelCoordinates(report, study, result);
  }
  Responses(report, study, shown);
  if (front > 0) FrontTable(report, study, result);
  report.Write(path);
}

}  // namespace ambrig
