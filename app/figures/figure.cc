#include "app/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "app/figures/series.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

std::string AxisKey(char letter, int panel) {
  return fmt::format("{}axis{}", letter, panel == 0 ? "" : std::to_string(panel + 1));
}

// Times at 450 kHz after some seconds need nine digits; what is drawn upwards needs five.
constexpr int kXDigits = 10, kYDigits = 5;

nlohmann::json LineStyleJson(const Style& s) {
  return {{"color", s.color}, {"width", s.width}, {"dash", s.dash}};
}

nlohmann::json Trace(int panel, const std::string& name, const Style& style) {
  nlohmann::json t = {{"type", "scatter"},    {"name", name},        {"xaxis", XRef(panel)},
                      {"yaxis", YRef(panel)}, {"legendgroup", name}, {"showlegend", style.legend}};
  t["mode"] = style.markers ? "markers" : "lines";
  if (style.markers)
    t["marker"] = {{"color", style.color}, {"size", style.size}};
  else
    t["line"] = LineStyleJson(style);
  if (style.steps) t["line"]["shape"] = "hv";
  return t;
}

void AddPoints(Figure& figure, int panel, const std::string& name, const Points& points,
               const Style& style) {
  nlohmann::json t = Trace(panel, name, style);
  t["x"] = Numbers(points.x, kXDigits);
  t["y"] = Numbers(points.y, kYDigits);
  figure.traces.push_back(std::move(t));
}

}  // namespace

Style SeriesStyle(int k) {
  static constexpr const char* kColors[] = {"@blue", "@orange", "@green", "@purple"};
  static constexpr const char* kDashes[] = {"solid", "dash", "dot"};
  Style style;
  style.color = kColors[k % 4];
  style.dash = kDashes[k / 4 % 3];
  return style;
}

std::string XRef(int panel) { return panel == 0 ? "x" : fmt::format("x{}", panel + 1); }
std::string YRef(int panel) { return panel == 0 ? "y" : fmt::format("y{}", panel + 1); }

nlohmann::json Numbers(std::span<const double> values, int digits) {
  nlohmann::json out = nlohmann::json::array();
  for (const double v : values) {
    if (!std::isfinite(v)) {
      out.push_back(nullptr);
      continue;
    }
    const double rounded = std::strtod(fmt::format("{:.{}g}", v, digits).c_str(), nullptr);
    if (rounded == std::round(rounded) && std::abs(rounded) < 1e9)
      out.push_back(static_cast<long>(rounded));  // "3", not "3.0"
    else
      out.push_back(rounded);
  }
  return out;
}

Figure MakeFigure(std::string caption, const Grid& grid) {
  Require(grid.rows > 0 && grid.columns > 0, "a grid has panels");
  Figure figure;
  figure.caption = std::move(caption);
  figure.panels = grid.rows * grid.columns;
  const bool titled = !grid.titles.empty();
  const bool own_x = !grid.shared_x;
  const int panel_height = grid.panel_height > 0 ? grid.panel_height : grid.rows == 1 ? 320 : 190;
  const double gap = (own_x ? 46 : 16) + (titled ? 24 : 0);
  const double inner = grid.rows * panel_height + (grid.rows - 1) * gap;
  const double top = titled ? 44 : 34, bottom = 84;
  figure.height = static_cast<int>(inner + top + bottom);
  figure.layout = {{"margin", {{"l", 68}, {"r", 18}, {"t", top}, {"b", bottom}}},
                   {"shapes", nlohmann::json::array()},
                   {"annotations", nlohmann::json::array()}};
  // Room for the numbers and titles of y; many columns have numbers only.
  const double dx = grid.columns == 1 ? 0 : grid.columns <= 3 ? 0.11 : 0.045;
  const double width = (1 - dx * (grid.columns - 1)) / grid.columns;
  for (int p = 0; p < figure.panels; ++p) {
    const int row = p / grid.columns, column = p % grid.columns;
    const double y1 = 1 - row * (panel_height + gap) / inner;
    const double y0 = std::max(0.0, y1 - panel_height / inner);
    const double x0 = column * (width + dx);
    nlohmann::json& x = figure.layout[AxisKey('x', p)];
    nlohmann::json& y = figure.layout[AxisKey('y', p)];
    x = {{"anchor", YRef(p)}, {"domain", {x0, std::min(1.0, x0 + width)}}};
    y = {{"anchor", XRef(p)}, {"domain", {y0, y1}}};
    if (grid.shared_x && row > 0) x["matches"] = XRef(column);
    if (grid.shared_x && row + 1 < grid.rows) x["showticklabels"] = false;
    if (static_cast<std::size_t>(p) < grid.titles.size() && !grid.titles[p].empty()) {
      nlohmann::json title = {{"text", "<b>" + grid.titles[p] + "</b>"},
                              {"showarrow", false},
                              {"font", {{"color", "@ink"}, {"size", 12}}}};
      title.update({{"xref", XRef(p) + " domain"},
                    {"yref", YRef(p) + " domain"},
                    {"x", 0},
                    {"y", 1},
                    {"xanchor", "left"},
                    {"yanchor", "bottom"}});
      figure.layout["annotations"].push_back(title);
    }
  }
  return figure;
}

void SetAxes(Figure& figure, int panel, const std::string& x, const std::string& y,
             std::optional<std::array<double, 2>> x_range,
             std::optional<std::array<double, 2>> y_range) {
  nlohmann::json& ax = figure.layout[AxisKey('x', panel)];
  nlohmann::json& ay = figure.layout[AxisKey('y', panel)];
  // With shared x only the bottom panel carries the title, as it alone carries the numbers.
  if (ax.value("showticklabels", true)) ax["title"] = {{"text", x}};
  ay["title"] = {{"text", y}};
  if (x_range) ax["range"] = *x_range;
  if (y_range) ay["range"] = *y_range;
}

void EqualAspect(Figure& figure, int panel) {
  figure.layout[AxisKey('y', panel)]["scaleanchor"] = XRef(panel);
  figure.layout[AxisKey('y', panel)]["scaleratio"] = 1;
  for (const char c : {'x', 'y'}) {
    figure.layout[AxisKey(c, panel)]["constrain"] = "domain";
    figure.layout[AxisKey(c, panel)]["zeroline"] = true;
  }
}

void LogAxes(Figure& figure, int panel, bool x, bool y) {
  if (x) figure.layout[AxisKey('x', panel)]["type"] = "log";
  if (y) figure.layout[AxisKey('y', panel)]["type"] = "log";
}

void AddLine(Figure& figure, int panel, const std::string& name, std::span<const double> x,
             std::span<const double> y, const Style& style) {
  AddPoints(figure, panel, name, Decimate(x, y), style);
}

void AddOrbit(Figure& figure, int panel, const std::string& name, std::span<const double> x,
              std::span<const double> y, const Style& style) {
  AddPoints(figure, panel, name, DecimateOrbit(x, y), style);
}

void AddBand(Figure& figure, int panel, const std::string& name, std::span<const double> x,
             std::span<const double> low, std::span<const double> high, const std::string& color) {
  Require(x.size() == low.size() && x.size() == high.size(), "a band of one size");
  Style edge;
  edge.color = color + "/50";
  edge.width = 0.8;
  edge.legend = false;
  Points below, above;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(low[i]) || !std::isfinite(high[i])) continue;
    below.x.push_back(x[i]);
    below.y.push_back(low[i]);
    above.y.push_back(high[i]);
  }
  above.x = below.x;
  AddPoints(figure, panel, name, below, edge);
  figure.traces.back()["hoverinfo"] = "skip";
  edge.legend = true;
  AddPoints(figure, panel, name, above, edge);
  figure.traces.back()["fill"] = "tonexty";
  figure.traces.back()["fillcolor"] = color + "/22";
  figure.traces.back()["hoverinfo"] = "skip";
}

void AddBars(Figure& figure, int panel, const std::string& name,
             const std::vector<std::string>& labels, std::span<const double> heights,
             const std::string& color) {
  Require(labels.size() == heights.size(), "a label per bar");
  figure.traces.push_back({{"type", "bar"},
                           {"name", name},
                           {"x", labels},
                           {"y", Numbers(heights)},
                           {"xaxis", XRef(panel)},
                           {"yaxis", YRef(panel)},
                           {"marker", {{"color", color}}}});
  figure.layout[AxisKey('x', panel)]["type"] = "category";
}

void AddHistogram(Figure& figure, int panel, const std::string& name,
                  std::span<const double> values, int bins, const std::string& color) {
  Require(bins > 0, "bins > 0");
  std::vector<double> finite;
  std::ranges::copy_if(values, std::back_inserter(finite),
                       [](double v) { return std::isfinite(v); });
  if (finite.empty()) return;
  const auto [low, high] = std::ranges::minmax(finite);
  const double width = high > low ? (high - low) / bins : 1.0;
  std::vector<double> centre(static_cast<std::size_t>(bins)), count(centre.size(), 0.0);
  for (int b = 0; b < bins; ++b) centre[static_cast<std::size_t>(b)] = low + (b + 0.5) * width;
  for (const double v : finite)
    ++count[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((v - low) / width)))];
  figure.traces.push_back({{"type", "bar"},
                           {"name", name},
                           {"x", Numbers(centre)},
                           {"y", Numbers(count)},
                           {"width", width},
                           {"xaxis", XRef(panel)},
                           {"yaxis", YRef(panel)},
                           {"marker", {{"color", color + "/80"}}}});
  figure.layout["bargap"] = 0;
  figure.layout["barmode"] = "overlay";
}

void AddHeatmap(Figure& figure, int panel, const std::vector<std::string>& columns,
                const std::vector<std::string>& rows,
                const std::vector<std::vector<double>>& values, const std::string& bar_title,
                int print) {
  Require(values.size() == rows.size(), "a heatmap row per name");
  nlohmann::json z = nlohmann::json::array();
  for (const auto& row : values) z.push_back(Numbers(row));
  nlohmann::json trace = {
      {"type", "heatmap"},
      {"x", columns},
      {"y", rows},
      {"z", z},
      {"xaxis", XRef(panel)},
      {"yaxis", YRef(panel)},
      {"colorscale", "@sequential"},
      {"xgap", 1},
      {"ygap", 1},
      {"colorbar", {{"title", {{"text", bar_title}, {"side", "right"}}}, {"thickness", 12}}}};
  if (print > 0) trace["texttemplate"] = fmt::format("%{{z:.{}~g}}", print);
  figure.traces.push_back(std::move(trace));
  nlohmann::json& y = figure.layout[AxisKey('y', panel)];
  y["autorange"] = "reversed";  // first row on top, as in a table
  y["automargin"] = true;
  y["type"] = figure.layout[AxisKey('x', panel)]["type"] = "category";
}

}  // namespace ambrig
