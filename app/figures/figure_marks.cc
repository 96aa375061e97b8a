// What is drawn on top of the data: circles, texts, regions, levels and marked instants.
#include <fmt/ranges.h>

#include <algorithm>

#include "app/figures/figure.h"

namespace ambrig {

namespace {

void AddShape(Figure& figure, nlohmann::json shape) {
  figure.layout["shapes"].push_back(std::move(shape));
}

nlohmann::json Annotation(const std::string& text, const std::string& color, int size) {
  return {{"text", text}, {"showarrow", false}, {"font", {{"color", color}, {"size", size}}}};
}

}  // namespace

void AddCircle(Figure& figure, int panel, double x, double y, double radius,
               const std::string& line, const std::string& fill, double width,
               const std::string& dash) {
  nlohmann::json shape = {{"type", "circle"},
                          {"xref", XRef(panel)},
                          {"yref", YRef(panel)},
                          {"x0", x - radius},
                          {"x1", x + radius},
                          {"y0", y - radius},
                          {"y1", y + radius},
                          {"layer", "below"},
                          {"line", {{"color", line}, {"width", width}, {"dash", dash}}}};
  if (!fill.empty()) shape["fillcolor"] = fill;
  AddShape(figure, std::move(shape));
}

void AddText(Figure& figure, int panel, double x, double y, const std::string& text,
             const std::string& color, int size) {
  nlohmann::json a = Annotation(text, color, size);
  a.update({{"xref", XRef(panel)}, {"yref", YRef(panel)}, {"x", x}, {"y", y}});
  figure.layout["annotations"].push_back(std::move(a));
}

void AddRegion(Figure& figure, int panel, double x0, double x1, const std::string& label,
               const std::string& color) {
  AddShape(figure, {{"type", "rect"},
                    {"xref", XRef(panel)},
                    {"yref", YRef(panel) + " domain"},
                    {"x0", x0},
                    {"x1", x1},
                    {"y0", 0},
                    {"y1", 1},
                    {"layer", "below"},
                    {"fillcolor", color},
                    {"line", {{"width", 0}}}});
  nlohmann::json a = Annotation(label, "@ink", 11);
  a.update({{"xref", XRef(panel)},
            {"yref", YRef(panel) + " domain"},
            {"x", (x0 + x1) / 2},
            {"y", 1},
            {"yanchor", "top"}});
  figure.layout["annotations"].push_back(std::move(a));
}

void AddLevel(Figure& figure, int panel, double y, const std::string& label,
              const std::string& color) {
  AddShape(figure, {{"type", "line"},
                    {"xref", XRef(panel) + " domain"},
                    {"yref", YRef(panel)},
                    {"x0", 0},
                    {"x1", 1},
                    {"y0", y},
                    {"y1", y},
                    {"line", {{"color", color}, {"width", 1.2}, {"dash", "dash"}}}});
  if (label.empty()) return;
  nlohmann::json a = Annotation(label, color, 11);
  a.update({{"xref", XRef(panel) + " domain"},
            {"yref", YRef(panel)},
            {"x", 1},
            {"y", y},
            {"xanchor", "right"},
            {"yanchor", "bottom"},
            {"yshift", 3},               // clear of the line
            {"bgcolor", "@paper/80"}});  // readable where a curve passes behind it
  figure.layout["annotations"].push_back(std::move(a));
}

void AddMarks(Figure& figure, std::span<const Mark> marks, std::array<double, 2> range) {
  std::vector<Mark> inside;
  std::ranges::copy_if(marks, std::back_inserter(inside),
                       [&](const Mark& m) { return m.x >= range[0] && m.x <= range[1]; });
  std::ranges::stable_sort(inside, {}, &Mark::x);
  for (const Mark& m : inside)
    for (int p = 0; p < figure.panels; ++p)
      AddShape(figure, {{"type", "line"},
                        {"xref", XRef(p)},
                        {"yref", YRef(p) + " domain"},
                        {"x0", m.x},
                        {"x1", m.x},
                        {"y0", 0},
                        {"y1", 1},
                        {"line", {{"color", m.color}, {"width", 1.4}, {"dash", "dot"}}}});
  // One label for what is closer than a short word is wide.
  const double near = 0.11 * (range[1] - range[0]);
  // The first level belongs to the panel's title where that stands, at the left.
  const bool at_title = !inside.empty() && inside[0].x < range[0] + 0.15 * (range[1] - range[0]);
  int group = at_title ? 1 : 0;
  for (std::size_t i = 0; i < inside.size(); ++group) {
    std::vector<std::string> labels{
        inside[i].label};  // each once: a bouncing rotor repeats its own
    std::size_t end = i + 1;
    for (; end < inside.size() && inside[end].x - inside[end - 1].x < near; ++end)
      if (std::ranges::find(labels, inside[end].label) == labels.end())
        labels.push_back(inside[end].label);
    const std::string text = fmt::format("{}", fmt::join(labels, " · "));
    const bool right_half = inside[i].x > 0.5 * (range[0] + range[1]);
    nlohmann::json a = Annotation(text, inside[i].color, 11);
    a.update({{"xref", "x"},
              {"yref", "y domain"},
              {"x", inside[right_half ? end - 1 : i].x},
              {"y", 1},
              {"yanchor", "bottom"},
              {"xanchor", right_half ? "right" : "left"},
              {"yshift", 13 * (group % 2)}});  // neighbours on two levels
    figure.layout["annotations"].push_back(std::move(a));
    i = end;
  }
}

}  // namespace ambrig
