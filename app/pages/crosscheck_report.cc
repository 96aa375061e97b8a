#include "app/pages/crosscheck_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/pages/html.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

constexpr double kMicro = 1e6, kMilli = 1e3;

Cell Micrometres(double value) { return Cell(fmt::format("{:.1f}", value * kMicro)); }

std::vector<Cell> FigureRow(const std::string& name, const CrosscheckRun& run, double parted) {
  const DropFigures& f = run.figures;
  std::string rest;
  for (std::size_t b = 0; b < f.rest.size(); ++b)
    rest += fmt::format("{}{} ({:.0f}, {:.0f})", b > 0 ? "; " : "", run.paths.bearings[b].bearing,
                        std::round(f.rest[b][0] * kMicro) + 0.0,  // not -0
                        std::round(f.rest[b][1] * kMicro) + 0.0);
  return {Cell(name),
          Cell(VerdictName(f), f.drop        ? "fail"
                               : f.touchdown ? "warn"
                                             : "ok"),
          Cell(f.first.empty() ? "–" : fmt::format("{:.3f}", f.touchdown_time * kMilli)),
          Micrometres(f.rebound),
          Micrometres(f.peak_orbit),
          Cell(fmt::format("{} ({:+.1f})", WhirlName(f.whirl), f.turns)),
          Cell(rest),
          Cell(f.severity > 0 ? fmt::format("{:.4f}", f.severity) : "–"),
          Cell(fmt::format("{:.2f}", f.fall_severity)),
          Cell(parted < 0 ? "–" : fmt::format("{:.1f}", parted * kMilli))};
}

struct Window {
  std::size_t begin = 0, size = 0;
};

/// From a little before the first touch to the end, or to 60 ms after it.
Window FromTouch(const ContactCrosscheck& w, bool zoom) {
  const DropPaths& p = w.model.paths;
  const double touch =
      w.model.figures.first.empty() ? w.ode.figures.touchdown_time : w.model.figures.touchdown_time;
  const std::size_t rows = p.bearings.front().x.size();
  const auto row = [&](double t) {
    return static_cast<std::size_t>(
        std::clamp((t - p.start) * p.rate, 0.0, static_cast<double>(rows)));
  };
  const std::size_t begin = row(touch - 0.01), end = zoom ? row(touch + 0.06) : rows;
  return {begin, end - begin};
}

std::vector<double> Part(const std::vector<double>& values, const Window& w, double factor) {
  const auto from = values.begin() + static_cast<std::ptrdiff_t>(w.begin);
  std::vector<double> part(from, from + static_cast<std::ptrdiff_t>(w.size));
  for (double& v : part) v *= factor;
  return part;
}

/// Largest radius of either witness's centre within the window [m].
double Reach(const ContactCrosscheck& w, const Window& window) {
  double reach = 0;
  for (const CrosscheckRun* run : {&w.model, &w.ode})
    for (const CentrePath& p : run->paths.bearings) {
      reach = std::max(reach, p.clearance);
      for (std::size_t k = window.begin; k < window.begin + window.size; ++k)
        reach = std::max(reach, std::hypot(p.x[k], p.y[k]));
    }
  return reach;
}

Figure Orbits(const ContactCrosscheck& w) {
  Grid grid;
  grid.rows = 2;
  grid.columns = static_cast<int>(w.model.paths.bearings.size());
  grid.shared_x = false;
  grid.panel_height = 380;
  for (const char* part : {", first 60 ms", ", to the end"})
    for (const CentrePath& p : w.model.paths.bearings)
      grid.titles.push_back("bearing " + p.bearing + part);
  Figure figure = MakeFigure(
      "Path of the shaft's centre from 10 ms before the first contact, by both contact models. "
      "Dashed: the clearance.",
      grid);
  for (int panel = 0; panel < figure.panels; ++panel) {
    const Window window = FromTouch(w, panel < grid.columns);
    const double reach = 1.1 * kMicro * Reach(w, window);
    const std::array<double, 2> range = {-reach, reach};
    SetAxes(figure, panel, "x [µm]", "y [µm]", range, range);
    EqualAspect(figure, panel);
    const auto bearing = static_cast<std::size_t>(panel % grid.columns);
    const CentrePath &model = w.model.paths.bearings[bearing], &ode = w.ode.paths.bearings[bearing];
    Style style = SeriesStyle(0);
    style.legend = panel == 0;
    AddOrbit(figure, panel, "compliant", Part(model.x, window, kMicro),
             Part(model.y, window, kMicro), style);
    style.color = "@orange";
    style.width = 1.0;
    AddOrbit(figure, panel, "on ODE", Part(ode.x, window, kMicro), Part(ode.y, window, kMicro),
             style);
    AddCircle(figure, panel, 0, 0, model.clearance * kMicro, "@ink", "", 1.5, "dash");
  }
  return figure;
}

Figure Radii(const ContactCrosscheck& w) {
  Grid grid;
  grid.rows = static_cast<int>(w.model.paths.bearings.size());
  for (const CentrePath& p : w.model.paths.bearings) grid.titles.push_back("bearing " + p.bearing);
  Figure figure = MakeFigure(
      "Distance of the shaft's centre from the middle in the first 60 ms of contact. Where all "
      "three diverge, the difference between the models is no larger than that of another noise "
      "seed.",
      grid);
  const Window zoom = FromTouch(w, true);
  std::vector<double> t(zoom.size);
  for (std::size_t k = 0; k < zoom.size; ++k) t[k] = w.model.paths.TimeAt(zoom.begin + k) * kMilli;
  for (int k = 0; k < grid.rows; ++k) {
    SetAxes(figure, k, k + 1 == grid.rows ? "time [ms]" : "", "radius [µm]");
    const std::pair<const char*, const CrosscheckRun*> runs[] = {
        {"compliant, other noise", &w.other_noise}, {"compliant", &w.model}, {"on ODE", &w.ode}};
    const char* colours[] = {"@gray/60", "@blue", "@orange"};
    for (std::size_t r = 0; r < 3; ++r) {
      const CentrePath& p = runs[r].second->paths.bearings[static_cast<std::size_t>(k)];
      std::vector<double> radius(zoom.size);
      for (std::size_t n = 0; n < zoom.size; ++n)
        radius[n] = std::hypot(p.x[zoom.begin + n], p.y[zoom.begin + n]) * kMicro;
      Style style;
      style.color = colours[r];
      style.legend = k == 0;
      AddLine(figure, k, runs[r].first, t, radius, style);
    }
    AddLevel(figure, k, w.model.paths.bearings[static_cast<std::size_t>(k)].clearance * kMicro,
             "clearance");
  }
  return figure;
}

void AddScenario(HtmlReport& report, const CrosscheckedScenario& s) {
  const ContactCrosscheck& w = s.crosscheck;
  report.Heading(s.name);
  report.Text("`" + s.file + "`");
  report.Verdict(w.verdicts_agree() ? Verdict::kOk : Verdict::kFail,
                 w.verdicts_agree()
                     ? "Both models agree: " + VerdictName(w.model.figures) + "."
                     : fmt::format("The compliant model says {}, the one on ODE {}.",
                                   VerdictName(w.model.figures), VerdictName(w.ode.figures)));
  report.Table({"rotor", "verdict", "touch [ms]", "rebound [µm]", "peak [µm]", "whirl (turns)",
                "rest (x, y) [µm]", "speed / Ωc", "speed / √(2gc)", "parts at [ms]"},
               {FigureRow("compliant", w.model, -1), FigureRow("on ODE", w.ode, w.parted_ode),
                FigureRow("compliant, other noise", w.other_noise, w.parted_noise)},
               "Divergence: the first time at which the centre is 5 % of the clearance away from "
               "that of the first row.");
  if (!w.contact()) return;
  report.AddFigure(Orbits(w));
  report.AddFigure(Radii(w));
}

}  // namespace

void WriteCrosscheckReport(const std::vector<CrosscheckedScenario>& scenarios,
                           const std::string& path) {
  HtmlReport report("Crosscheck of two contact models", Counted(scenarios.size(), "scenario"));
  report.Text(
      "The same scenarios with the rotor on compliant auxiliary bearings and with the rotor as "
      "rigid "
      "bodies of the Open Dynamics Engine; magnets, loops and faults are the same in both.");
  report.Heading("Verdicts");
  std::vector<std::vector<Cell>> rows;
  for (const CrosscheckedScenario& s : scenarios) {
    const ContactCrosscheck& w = s.crosscheck;
    rows.push_back(
        {Cell(s.name), Cell(std::to_string(s.seed)), Cell(VerdictName(w.model.figures)),
         Cell(VerdictName(w.ode.figures)),
         Cell(w.verdicts_agree() ? "✓ agree" : "✗ differ", w.verdicts_agree() ? "ok" : "fail")});
  }
  report.Table({"scenario", "seed", "compliant", "on ODE", ""}, rows);
  for (const CrosscheckedScenario& s : scenarios)
    if (s.crosscheck.contact() && !s.crosscheck.model.paths.bearings.empty())
      AddScenario(report, s);
  report.Write(path);
}

}  // namespace ambrig
