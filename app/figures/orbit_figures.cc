// Paths of the shaft's centre in the bearings and in the named planes of a beam rotor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/run_figures.h"
#include "app/figures/series.h"

namespace ambrig {
namespace {

struct Stage {
  const char* name;
  const char* color;
  double from, to;  // [s]
};

std::vector<Stage> Stages(const RunStages& s) {
  if (!s.fault) return {{"whole run", "@blue", s.whole[0], s.whole[1]}};
  if (!s.reaction)
    return {{"after the fault", "@red", *s.fault, s.whole[1]},
            {"before the fault", "@blue", s.whole[0], *s.fault}};
  // Drawn in this order: the long steady part lies below, the short one on top.
  return {{"after the reaction", "@green", *s.reaction, s.whole[1]},
          {"before the fault", "@blue", s.whole[0], *s.fault},
          {"fault to reaction", "@red", *s.fault, *s.reaction}};
}

/// A plane whose path is drawn: a bearing, or a station of a beam rotor.
struct Plane {
  std::string title;
  double clearance;  // [m]; 0: nothing to touch there
  const std::vector<double>*x, *y;
  double peak;  // [m]
};

std::vector<Plane> OrbitPlanesOf(const RunReportData& data) {
  std::vector<Plane> planes;
  for (const ReportBearing& b : data.bearings)
    planes.push_back({"bearing " + b.name, b.clearance, &b.x, &b.y, LargestRadius(b.x, b.y)});
  for (const ReportStation& s : data.stations)
    planes.push_back({s.name, 0, &s.x, &s.y, LargestRadius(s.x, s.y)});
  return planes;
}

void AddPaths(Figure& figure, int panel, const RunReportData& data, const Plane& plane,
              const RunStages& stages, double factor) {
  const std::size_t rows = plane.x->size();
  const auto row = [&](double t) {
    const double r = std::round((t - data.start) * data.rate);
    return static_cast<std::size_t>(std::clamp(r, 0.0, static_cast<double>(rows)));
  };
  for (const Stage& stage : Stages(stages)) {
    const std::size_t begin = row(stage.from), end = std::min(rows, row(stage.to) + 1);
    if (end <= begin) continue;
    Style style;
    style.color = stage.color;
    style.width = std::string_view(stage.color) == "@red" ? 2.2 : 1.1;
    style.legend = panel == 0;
    AddOrbit(figure, panel, stage.name,
             Scaled(std::span(*plane.x).subspan(begin, end - begin), factor),
             Scaled(std::span(*plane.y).subspan(begin, end - begin), factor), style);
  }
}

std::string Caption(bool close_up, bool stations) {
  std::string text =
      "Path of the shaft's centre in each radial bearing. The dashed circle is the clearance of "
      "the auxiliary bearing: beyond it the shaft touches.";
  if (stations)
    text += " Named planes of the shaft beside them, about where they stood at the start.";
  if (close_up) text += " Below, the same paths enlarged.";
  return text;
}

}  // namespace

Figure OrbitFigure(const RunReportData& data, const RunStages& stages) {
  const std::vector<Plane> planes = OrbitPlanesOf(data);
  double peak = 0, clearance = 0, reach = 0;
  for (const Plane& p : planes) {
    peak = std::max(peak, p.peak);
    clearance = std::max(clearance, p.clearance);
    reach = std::max({reach, p.peak, p.clearance});
  }
  // A small orbit is a dot inside the clearance; then a second row shows it large.
  const bool close_up = peak < 0.4 * clearance;
  const auto columns = static_cast<int>(planes.size());
  Grid grid;
  grid.columns = columns;
  grid.rows = close_up ? 2 : 1;
  for (const Plane& p : planes) grid.titles.push_back(p.title);
  if (close_up)
    for (const Plane& p : planes) grid.titles.push_back(p.title + ", close-up");
  grid.shared_x = false;
  grid.panel_height = columns > 2 ? 260 : 360;
  Figure figure = MakeFigure(Caption(close_up, !data.stations.empty()), grid);
  const DisplayUnit unit = ChooseUnit(clearance > 0 ? clearance : peak, "m");
  for (int p = 0; p < figure.panels; ++p) {
    const Plane& plane = planes[static_cast<std::size_t>(p % columns)];
    const bool above = p < columns;
    const double own = plane.clearance > 0 ? std::max(plane.clearance, plane.peak) : reach;
    const double limit = 1.12 * (above ? own : peak) * unit.factor;
    const std::array<double, 2> range = {-limit, limit};
    SetAxes(figure, p, fmt::format("x [{}]", unit.name), fmt::format("y [{}]", unit.name), range,
            range);
    EqualAspect(figure, p);
    AddPaths(figure, p, data, plane, stages, unit.factor);
    if (above && plane.clearance > 0)
      AddCircle(figure, p, 0, 0, plane.clearance * unit.factor, "@ink", "", 1.5, "dash");
  }
  return figure;
}

}  // namespace ambrig
