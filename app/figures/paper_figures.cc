#include "app/figures/paper_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/text/format.h"

namespace ambrig {

namespace {

constexpr double kStepAt = 0.002;  // [s] examples/paper/step_*.toml

struct PaperWindow {
  std::vector<double> t, i;  // [ms] or [µs] after `origin`, [A]
};

/// Samples from `from` to `to`, times after `origin` in units of `unit` [s].
PaperWindow WindowOf(const PaperRun& run, double from, double to, double origin, double unit,
                     const std::string& channel = {}) {
  const Record& r = run.result.record;
  const std::vector<double>& all =
      r.Find(channel.empty() ? CoilCurrent(run.rig) : channel)->samples;
  PaperWindow w;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (const double t = r.TimeAt(k); t >= from - 1e-9 && t < to - 1e-9) {
      w.t.push_back((t - origin) / unit);
      w.i.push_back(all[k]);
    }
  return w;
}

double FaultAt(const PaperRun& run) { return run.scenario.faults.front().time; }
double PeriodOf(const PaperRun& run) { return 1 / run.rig.amplifier.switching_frequency; }
bool Opens(const PaperRun& run) { return run.scenario.faults.front().kind == "open"; }
const char* FaultWords(const PaperRun& run) {
  return Opens(run) ? "broken circuit" : "partial short circuit";
}

Style Thin(const std::string& colour) {
  Style s;
  s.color = colour;
  s.width = 1;
  s.legend = false;
  return s;
}

void AddSamples(Figure& figure, int panel, const std::string& name, const PaperWindow& w,
                const std::string& colour, bool legend = false) {
  Style points = Thin(colour);
  points.markers = true;
  points.legend = legend;
  AddLine(figure, panel, name + ", line", w.t, w.i, Thin("@muted"));
  AddLine(figure, panel, name, w.t, w.i, points);
}

}  // namespace

Figure PaperFigure4(const PaperStudy& study) {
  const PaperRun& run = study.steps[0];
  Grid grid;
  grid.rows = 2;
  grid.titles = {"(a) excitation signal", "(b) load current"};
  Figure figure = MakeFigure(
      "The paper's figure 4: desired current of the coil of 0.5 ohm and 2 mH, a step of 1 A, and "
      "the load "
      "current that follows it, every sample of the converter.",
      grid);
  const double to = kStepAt + 6e-3;
  const PaperWindow set = WindowOf(run, 0, to, 0, 1e-3, run.rig.bearings[0].name + ".s1"),
                    load = WindowOf(run, 0, to, 0, 1e-3);
  Style steps = Thin("@orange");
  steps.width = 2;
  AddLine(figure, 0, "desired", set.t, set.i, steps);
  AddLine(figure, 1, "load current", load.t, load.i, Thin("@blue"));
  SetAxes(figure, 0, "", "current [A]", std::array{0.0, to * 1e3});
  SetAxes(figure, 1, "time [ms]", "current [A]", std::array{0.0, to * 1e3});
  return figure;
}

Figure PaperFigure5(const PaperStudy& study) {
  Figure figure = MakeFigure(
      "The paper's figure 5: load current over three switching periods when the step has settled. "
      "The slope k "
      "of the coil of 0.5 ohm and 2 mH is half of k' of the coil of 0.2 ohm and 1 mH.");
  const char* names[] = {"k: 0.5 ohm, 2 mH", "k': 0.2 ohm, 1 mH"};
  const char* colours[] = {"@blue", "@orange"};
  for (int c = 0; c < 2; ++c) {
    const PaperRun& run = study.steps[static_cast<std::size_t>(c)];
    const double from = 0.018;
    AddSamples(figure, 0, fmt::format("{}, {:.0f} A/s", names[c], run.slopes.increasing.back()),
               WindowOf(run, from, from + 3 * PeriodOf(run), from, 1e-6), colours[c], true);
  }
  SetAxes(figure, 0, "time [µs]", "current [A]");
  return figure;
}

Figure PaperFigure11(const PaperStudy& study) {
  const std::vector<double>& k = study.healthy.slopes.increasing;
  Figure figure = MakeFigure(fmt::format(
      "The paper's figure 11: histogram of the equivalent slope of {} switching periods in a row. "
      "Shaded: the theoretical range of Eq. 9; dashed: that range widened by {} A/s.",
      k.size(), kPaperMargin));
  AddHistogram(figure, 0, "k", k, 40);
  figure.traces.back()["showlegend"] = false;
  const auto [least, most] = std::minmax_element(k.begin(), k.end());
  const double low = study.theory.low - kPaperMargin, high = study.theory.high + kPaperMargin;
  const std::array range{std::min(*least, low) - 100, std::max(*most, high) + 100};
  AddRegion(figure, 0, study.theory.low, study.theory.high, "Eq. 9", "@green/30");
  SetAxes(figure, 0, "equivalent slope [A/s]", "switching periods [-]", range);
  const Mark marks[] = {{low, "k'min", "@ink"}, {high, "k'max", "@ink"}};
  AddMarks(figure, marks, range);
  return figure;
}

Figure PaperWaveform(const PaperRun& run, int number) {
  const double fault = FaultAt(run), act = run.look.flagged;
  const double from = fault - 15e-3, to = std::min(fault + 15e-3, run.scenario.duration);
  Figure figure = MakeFigure(fmt::format(
      "The paper's figure {}: current under pulse excitation, {}. A normal stage, B fault stage, C "
      "fault-tolerant stage{}.",
      number, FaultWords(run),
      act < 0 ? " (none: no flag)"
              : ", in which the bridge is switched off on the detector's flag"));
  const PaperWindow w = WindowOf(run, from, to, 0, 1e-3);
  AddLine(figure, 0, "current", w.t, w.i, Thin("@blue"));
  AddRegion(figure, 0, from * 1e3, fault * 1e3, "A", "@blue/10");
  AddRegion(figure, 0, fault * 1e3, (act < 0 ? to : act) * 1e3, "B", "@red/20");
  if (act >= 0) AddRegion(figure, 0, act * 1e3, to * 1e3, "C", "@green/10");
  SetAxes(figure, 0, "time [ms]", "current [A]", std::array{from * 1e3, to * 1e3});
  return figure;
}

Figure PaperSamplingPoints(const PaperRun& run, int number) {
  Grid grid;
  grid.columns = 2;
  grid.shared_x = false;
  grid.panel_height = 300;
  grid.titles = {"(a) normal stage (A)", "(b) fault stage (B)"};
  Figure figure =
      MakeFigure(fmt::format("The paper's figure {}: sampling points of the load current, 18 in a "
                             "switching period, before and after the {}.",
                             number, FaultWords(run)),
                 grid);
  const double T = PeriodOf(run), fault = FaultAt(run);
  const double begin[] = {fault - 10 * T, fault + 10 * T};
  double most = 0;
  for (int p = 0; p < 2; ++p) {
    const PaperWindow w = WindowOf(run, begin[p], begin[p] + 4 * T, begin[p], 1e-6);
    most = std::max(most, *std::max_element(w.i.begin(), w.i.end()));
    AddSamples(figure, p, "samples", w, p == 0 ? "@blue" : "@red");
  }
  for (int p = 0; p < 2; ++p)
    SetAxes(figure, p, "time [µs]", "current [A]", {}, std::array{-0.05 * most, 1.1 * most});
  return figure;
}

Figure PaperSlopeRange(const PaperRun& run, int number) {
  const double fault = FaultAt(run), from = fault - 5e-3, to = fault + 5e-3;
  std::vector<double> t, k;
  double least = kInfinity, most = -kInfinity, low = 0, high = 0;
  for (std::size_t n = 0; n < run.slopes.t.size(); ++n) {
    const double at = run.slopes.t[n];
    if (at < from || at >= to) continue;
    t.push_back((at - fault) * 1e3);
    k.push_back(run.slopes.increasing[n]);
    if (at < fault) low = run.slopes.low[n], high = run.slopes.high[n];
    // A period of two states is of neither; from the flag on the bridge is off.
    if (at < fault + PeriodOf(run) || (run.look.flagged > 0 && at > run.look.flagged - 1e-9))
      continue;
    least = std::min(least, k.back());
    most = std::max(most, k.back());
  }
  Figure figure = MakeFigure(fmt::format(
      "The paper's figure {}: range of the equivalent slope. k'min = {:.0f} and k'max = {:.0f} A/s "
      "of the normal stage (Eq. 9 and {} A/s), k1 = {:.0f} and k2 = {:.0f} A/s, the "
      "largest and the smallest slope under {}.",
      number, low, high, kPaperMargin, most, least, FaultWords(run)));
  Style points = Thin("@blue");
  points.markers = true;
  points.size = 4;
  AddLine(figure, 0, "equivalent slope", t, k, points);
  AddLevel(figure, 0, low, "k'min", "@green");
  AddLevel(figure, 0, high, "k'max", "@green");
  AddLevel(figure, 0, most, "k1", "@red");
  AddLevel(figure, 0, least, "k2", "@red");
  SetAxes(figure, 0, "time after the fault [ms]", "equivalent slope [A/s]");
  return figure;
}

Figure PaperFlag(const PaperRun& run, int number) {
  const double fault = FaultAt(run), from = fault - 2e-3, to = fault + 5e-3;
  const double flag = run.look.flagged;
  Grid grid;
  grid.rows = 2;
  grid.titles = {"fault-diagnosis flag, low for a fault", "load current"};
  Figure figure = MakeFigure(
      fmt::format(
          "The paper's figure {}: time for fault diagnosis t_d under {}: {}; {:.2f} to {:.2f} ms, "
          "{:.2f} ms in the mean, with the fault at every place of the cycle.",
          number, FaultWords(run),
          flag < fault ? "none" : fmt::format("{:.2f} ms here", (flag - fault) * 1e3),
          run.delays.least * 1e3, run.delays.most * 1e3, run.delays.mean * 1e3),
      grid);
  const auto after = [&](double t) { return (t - fault) * 1e3; };
  const std::vector<double> t{after(from), after(flag < 0 ? to : flag), after(to)};
  const std::vector<double> high{1, flag < 0 ? 1.0 : 0.0, flag < 0 ? 1.0 : 0.0};
  Style steps = Thin("@red");
  steps.width = 2;
  steps.steps = true;
  AddLine(figure, 0, "flag", t, high, steps);
  const PaperWindow w = WindowOf(run, from, to, fault, 1e-3);
  AddLine(figure, 1, "load current", w.t, w.i, Thin("@blue"));
  const std::array range{after(from), after(to)};
  SetAxes(figure, 0, "", "flag [-]", range, std::array{-0.2, 1.2});
  SetAxes(figure, 1, "time after the fault [ms]", "current [A]", range);
  const Mark marks[] = {{0, "fault", "@red"}, {after(flag), "flag", "@ink"}};
  AddMarks(figure, std::span(marks, flag < 0 ? 1 : 2), range);
  return figure;
}

}  // namespace ambrig
