#include "app/figures/speed_figures.h"

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/text/format.h"
#include "core/math/constants.h"
#include "core/math/order_tracking.h"

namespace ambrig {

namespace {

constexpr double kWindows = 120;       // columns of a waterfall
constexpr double kLeastChange = 0.05;  // of the highest speed
constexpr double kFloor = 1e-4;        // of the largest amplitude: below it all is one colour

struct SpeedPlane {
  std::string title;
  std::span<const double> x, y;
};

std::vector<SpeedPlane> SpeedPlanesOf(const RunReportData& data) {
  std::vector<SpeedPlane> planes;
  for (const ReportBearing& b : data.bearings)
    if (!b.x.empty()) planes.push_back({"bearing " + b.name, b.x, b.y});
  for (const ReportStation& s : data.stations)
    if (!s.x.empty()) planes.push_back({s.name, s.x, s.y});
  return planes;
}

std::vector<double> SpeedOf(const RunReportData& data) {  // [Hz]
  std::vector<double> f(data.theta.size(), 0.0);
  for (std::size_t k = 1; k < f.size(); ++k)
    f[k] = (data.theta[k] - data.theta[k - 1]) * data.rate / (2 * kPi);
  if (f.size() > 1) f[0] = f[1];
  return f;
}

double Largest(const std::vector<double>& v) {
  double top = 0;
  for (double x : v) top = std::max(top, std::abs(x));
  return top;
}

/// Long enough for a few turns at a tenth of the top speed, short against the run.
double SpanFor(double duration, double f_top) {
  return std::clamp(30 / f_top, 8 / f_top, duration / 8);
}

double At(const RunReportData& data, const std::vector<double>& v, double t) {
  const double row =
      std::clamp((t - data.start) * data.rate, 0.0, static_cast<double>(v.size() - 1));
  return v[static_cast<std::size_t>(row)];
}

struct SpeedRun {
  std::vector<double> speed;  // [Hz]
  double top = 0, duration = 0, span = 0, hop = 0;
};

SpeedRun MakeSpeedRun(const RunReportData& data) {
  SpeedRun run;
  run.speed = SpeedOf(data);
  run.top = Largest(run.speed);
  run.duration = static_cast<double>(data.theta.size()) / data.rate;
  run.span = SpanFor(run.duration, run.top);
  run.hop = (run.duration - run.span) / kWindows;
  return run;
}

/// 20 log10 of the amplitude over one metre's display unit, never below the floor.
std::vector<std::vector<double>> Decibels(const WaterfallSpectrum& w, double factor) {
  double top = 0;
  for (const auto& row : w.amplitude) top = std::max(top, Largest(row));
  std::vector<std::vector<double>> out(w.frequency.size(), std::vector<double>(w.t.size()));
  for (std::size_t k = 0; k < w.t.size(); ++k)
    for (std::size_t f = 0; f < w.frequency.size(); ++f)
      out[f][k] = 20 * std::log10(factor * std::max(w.amplitude[k][f], kFloor * top + 1e-300));
  return out;
}

void AddMap(Figure& figure, int panel, const WaterfallSpectrum& w, double factor,
            const std::string& unit) {
  nlohmann::json z = nlohmann::json::array();
  for (const auto& row : Decibels(w, factor)) z.push_back(Numbers(row, 3));
  nlohmann::json trace = {{"type", "heatmap"},
                          {"x", Numbers(w.t)},
                          {"y", Numbers(w.frequency)},
                          {"z", z},
                          {"colorscale", "Viridis"},
                          {"xaxis", XRef(panel)},
                          {"yaxis", YRef(panel)},
                          {"showscale", panel == 0},
                          {"hovertemplate", "%{x} s, %{y} Hz: %{z} dB<extra></extra>"}};
  if (panel == 0) trace["colorbar"] = {{"title", {{"text", "dB re 1 " + unit}}}, {"thickness", 12}};
  figure.traces.push_back(trace);
}

/// One panel a plane, one below the other.
Figure PanelPerPlane(const std::vector<SpeedPlane>& planes, int height, const char* caption) {
  Grid grid;
  grid.rows = static_cast<int>(planes.size());
  grid.panel_height = height;
  for (const SpeedPlane& p : planes) grid.titles.push_back(p.title);
  return MakeFigure(caption, grid);
}

}  // namespace

bool SpeedVaries(const RunReportData& data) {
  if (data.theta.size() < 64 || SpeedPlanesOf(data).empty()) return false;
  const std::vector<double> f = SpeedOf(data);
  const auto [low, high] = std::ranges::minmax(f);
  const SpeedRun run = MakeSpeedRun(data);
  return high - low > kLeastChange * Largest(f) && run.top * run.duration > 8 * kLeastTurns;
}

Figure WaterfallFigure(const RunReportData& data) {
  const std::vector<SpeedPlane> planes = SpeedPlanesOf(data);
  const SpeedRun run = MakeSpeedRun(data);
  Figure figure =
      PanelPerPlane(planes, 260,
                    "Waterfall: amplitude of the shaft centre's motion over time and frequency; "
                    "forward whirl has positive, backward whirl negative frequencies. The line is "
                    "the rotational frequency: components that follow it are of order 1; "
                    "horizontal ones are modes of the rotor in its bearings.");
  double peak = 0;
  for (const SpeedPlane& p : planes) peak = std::max({peak, LargestSize(p.x), LargestSize(p.y)});
  const DisplayUnit unit = ChooseUnit(peak, "m");
  const double f_max = std::min(data.rate / 2.56, std::max(5 * run.top, 50.0));
  const std::vector<double> time = UniformTime(data.start, data.rate, run.speed.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const int panel = static_cast<int>(k);
    AddMap(figure, panel,
           Waterfall({planes[k].x, planes[k].y, data.rate, data.start}, run.span, run.hop, f_max),
           unit.factor, unit.name);
    Style style;
    style.color = "@red";
    style.width = 1;
    style.legend = false;
    AddLine(figure, panel, "speed", time, run.speed, style);
    SetAxes(figure, panel, "time [s]", "frequency [Hz]", {}, std::array<double, 2>{-f_max, f_max});
  }
  return figure;
}

std::optional<Figure> OrderFigure(const RunReportData& data) {
  const std::vector<SpeedPlane> planes = SpeedPlanesOf(data);
  const SpeedRun run = MakeSpeedRun(data);
  Figure figure = PanelPerPlane(
      planes, 220,
      "Order tracks: the part of the motion that turns with the shaft (order 1: unbalance, bow, "
      "run-out), at twice its speed, and against it, over the speed. A peak of order 1 is a "
      "critical speed.");
  bool any = false;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const int panel = static_cast<int>(k);
    const Orbit orbit{planes[k].x, planes[k].y, data.rate, data.start};
    struct Line {
      const char* name;
      double order;
      bool forward;
    };
    int number = 0;
    for (const Line& line : {Line{"order 1, forward", 1, true},
                             {"order 2, forward", 2, true},
                             {"order 1, backward", 1, false}}) {
      const TrackedOrder track = TrackOrder(orbit, data.theta, line.order, run.span, run.hop);
      std::vector<double> speed, size;
      for (std::size_t i = 0; i < track.t.size(); ++i) {
        const double a = std::abs(line.forward ? track.forward[i] : track.backward[i]);
        any = any || std::isfinite(a);
        speed.push_back(30 / kPi * 2 * kPi * At(data, run.speed, track.t[i]));
        size.push_back(1e6 * a);
      }
      Style style = SeriesStyle(number++);
      style.legend = k == 0;
      AddLine(figure, panel, line.name, speed, size, style);
    }
    SetAxes(figure, panel, "speed [rpm]", "amplitude [µm]");
  }
  if (!any) return std::nullopt;
  return figure;
}

}  // namespace ambrig
