#include "app/figures/rig_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/text/format.h"
#include "core/base/errors.h"

namespace ambrig {
namespace {

// Radii and widths of the schematic; the shaft's radius is one.
constexpr double kClearance = 0.22;  // how far the drawn shaft can move
constexpr double kPoleFace = 1.34, kYokeInner = 1.95, kYokeOuter = 2.25, kLabel = 2.45;
constexpr double kPoleHalf = 0.2, kCoilWidth = 0.13, kCoilFrom = 1.46, kCoilTo = 1.84;

// A rectangle from radius r0 to r1, sideways from s0 to s1, turned to the angle of its pole.
std::string TurnedRectangle(double angle, double r0, double r1, double s0, double s1) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::string path;
  const double corners[4][2] = {{r0, s0}, {r1, s0}, {r1, s1}, {r0, s1}};
  for (const auto& [r, side] : corners)
    path += fmt::format("{}{:.4f},{:.4f} ", path.empty() ? "M" : "L", r * c - side * s,
                        r * s + side * c);
  return path + "Z";
}

void AddPath(Figure& figure, int panel, const std::string& path, const std::string& fill,
             const std::string& line, double width, const std::string& dash = "solid") {
  figure.layout["shapes"].push_back(
      {{"type", "path"},
       {"path", path},
       {"xref", XRef(panel)},
       {"yref", YRef(panel)},
       {"layer", "below"},
       {"fillcolor", fill},
       {"line", {{"color", line}, {"width", width}, {"dash", dash}}}});
}

int PercentOf(double value, double largest) {
  return largest > 0 ? static_cast<int>(std::lround(100 * std::min(1.0, std::abs(value) / largest)))
                     : 0;
}

struct Scale {
  double flux = 0, current = 0;  // the largest of all views
};

void DrawPole(Figure& figure, int panel, const StatorView& view, std::size_t j,
              const Scale& scale) {
  const double angle = view.pole_angles[j];
  const bool failed = std::ranges::find(view.failed, static_cast<int>(j) + 1) != view.failed.end();
  const double flux = view.flux.empty() ? 0 : view.flux[j];
  const std::string color = flux >= 0 ? "@blue" : "@orange";
  const std::string body =
      TurnedRectangle(angle, kPoleFace, kYokeInner + 0.03, -kPoleHalf, kPoleHalf);
  AddPath(figure, panel, body, "@paper", "@muted", 0);
  AddPath(figure, panel, body, fmt::format("{}/{}", color, PercentOf(flux, scale.flux)), "@muted",
          1);
  for (const double side : {-1.0, 1.0}) {
    const double s0 = side * kPoleHalf, s1 = side * (kPoleHalf + kCoilWidth);
    const std::string coil = TurnedRectangle(angle, kCoilFrom, kCoilTo, s0, s1);
    const int fill = view.current.empty() ? 0 : PercentOf(view.current[j], scale.current);
    AddPath(figure, panel, coil, fmt::format("@green/{}", fill), failed ? "@red" : "@muted",
            failed ? 2.2 : 0.8, failed ? "dot" : "solid");
  }
  const std::string name = fmt::format("{}{}", view.bearing, j + 1);
  std::string label = fmt::format("<b>{}{}</b>", failed ? "✗ " : "", name);
  if (!view.flux.empty()) label += "<br>" + FormatSi(flux, "Wb", 3);
  AddText(figure, panel, kLabel * std::cos(angle), kLabel * std::sin(angle), label,
          failed ? "@red" : "@ink", 10);
  // Beside the ring the text begins where it stops, above and below it is centred.
  const double side = std::cos(angle);
  if (std::abs(side) > 0.3)
    figure.layout["annotations"].back()["xanchor"] = side > 0 ? "left" : "right";
}

// Invisible points at the poles, so that the pointer finds the numbers.
void AddHover(Figure& figure, int panel, const StatorView& view) {
  nlohmann::json x = nlohmann::json::array(), y = nlohmann::json::array(),
                 text = nlohmann::json::array();
  for (std::size_t j = 0; j < view.flux.size(); ++j) {
    x.push_back(1.65 * std::cos(view.pole_angles[j]));
    y.push_back(1.65 * std::sin(view.pole_angles[j]));
    std::string line =
        fmt::format("{}{}: {}", view.bearing, j + 1, FormatSi(view.flux[j], "Wb", 4));
    if (!view.current.empty()) line += ", " + FormatSi(view.current[j], "A", 4);
    text.push_back(line);
  }
  figure.traces.push_back({{"type", "scatter"},
                           {"mode", "markers"},
                           {"x", x},
                           {"y", y},
                           {"text", text},
                           {"hoverinfo", "text"},
                           {"xaxis", XRef(panel)},
                           {"yaxis", YRef(panel)},
                           {"showlegend", false},
                           {"marker", {{"size", 22}, {"opacity", 0}}}});
}

void DrawView(Figure& figure, int panel, const StatorView& view, const Scale& scale) {
  const std::size_t poles = view.pole_angles.size();
  Require(view.flux.empty() || poles == view.flux.size(), "a flux per pole");
  Require(view.current.empty() || view.current.size() == poles, "a current per pole");
  AddCircle(figure, panel, 0, 0, kYokeOuter, "@muted", "@faint", 1);
  AddCircle(figure, panel, 0, 0, kYokeInner, "@muted", "@paper", 1);
  for (std::size_t j = 0; j < poles; ++j) DrawPole(figure, panel, view, j, scale);
  const double to_drawing = view.clearance > 0 ? kClearance / view.clearance : 0;
  const double x = view.x * to_drawing, y = view.y * to_drawing;
  AddCircle(figure, panel, 0, 0, 1 + kClearance, "@muted", "", 1.2, "dash");
  AddCircle(figure, panel, x, y, 1, "@ink", "@gray/30", 1.5);
  AddCircle(figure, panel, x, y, 0.035, "@ink", "@ink", 1);
  AddText(figure, panel, 0, 0, "+", "@muted", 14);  // the stator's centre
  if (view.flux.empty()) return;
  AddText(figure, panel, 0, -0.3,
          fmt::format("{} of {}", FormatSi(std::hypot(view.x, view.y), "m", 3),
                      FormatSi(view.clearance, "m", 3)),
          "@ink", 10);
  AddHover(figure, panel, view);
}

}  // namespace

Figure StatorFigure(std::string caption, std::span<const StatorView> views) {
  const int count = std::max(1, static_cast<int>(views.size()));
  Grid grid;
  grid.columns = std::min(2, count);
  grid.rows = (count + grid.columns - 1) / grid.columns;
  grid.shared_x = false;
  grid.panel_height = 340;
  Scale scale;
  for (const StatorView& v : views) {
    grid.titles.push_back(v.title);
    scale.flux = std::max(scale.flux, LargestSize(v.flux));
    scale.current = std::max(scale.current, LargestSize(v.current));
  }
  Figure figure = MakeFigure(std::move(caption), grid);
  figure.layout["margin"] = {{"l", 8}, {"r", 8}, {"t", 44}, {"b", 8}};
  figure.height -= 76;
  for (int p = 0; p < static_cast<int>(views.size()); ++p) {
    DrawView(figure, p, views[static_cast<std::size_t>(p)], scale);
    SetAxes(figure, p, "", "", std::array{-3.6, 3.6}, std::array{-2.75, 2.75});
    EqualAspect(figure, p);
    for (const char c : {'x', 'y'})
      figure.layout[fmt::format("{}axis{}", c, p == 0 ? "" : std::to_string(p + 1))]["visible"] =
          false;
  }
  for (int p = static_cast<int>(views.size()); p < figure.panels;
       ++p)  // an empty place in the grid
    for (const char c : {'x', 'y'})
      figure.layout[fmt::format("{}axis{}", c, p + 1)]["visible"] = false;
  return figure;
}

}  // namespace ambrig
