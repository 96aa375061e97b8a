#include <fmt/format.h>

#include <algorithm>

#include "app/pages/explain_tables.h"
#include "app/text/format.h"

namespace ambrig {

void AddScreening(HtmlReport& report, const Explanation& e, bool unseen) {
  if (e.screened.empty()) return;
  report.Heading("Screening of all effects", 3);
  std::vector<std::string> names;
  std::vector<double> ratios;
  const std::string of = unseen ? "unseen records" : "all records";
  for (std::size_t k = 0; k < e.screened.size() && k < 15; ++k) {
    names.push_back(EffectName(e.screened[k].effect));
    ratios.push_back(e.screened[k].ratio_validate);
  }
  Grid grid;
  grid.panel_height = std::max(120, 22 * static_cast<int>(names.size()));
  Figure figure = MakeFigure(
      fmt::format("Screening: the error over noise that each effect at each target would leave on "
                  "{}, estimated from a few simulations (linear). The best {} of {}, by {} "
                  "and the number of their parameters. Dashed: without any effect.",
                  of, names.size(), e.screened.size(), unseen ? "fit and unseen records" : "fit"),
      grid);
  figure.traces.push_back({{"type", "bar"},
                           {"orientation", "h"},
                           {"name", of},
                           {"x", Numbers(ratios)},
                           {"y", names},
                           {"xaxis", "x"},
                           {"yaxis", "y"},
                           {"texttemplate", "%{x:.3~g}"},
                           {"marker", {{"color", "@blue"}}}});
  SetAxes(figure, 0, "error / noise on " + of, "");
  figure.layout["yaxis"].update(
      {{"autorange", "reversed"}, {"automargin", true}, {"type", "category"}});
  figure.layout["shapes"].push_back(
      {{"type", "line"},
       {"xref", "x"},
       {"yref", "y domain"},
       {"x0", e.base_ratio_validate},
       {"x1", e.base_ratio_validate},
       {"y0", 0},
       {"y1", 1},
       {"line", {{"color", "@red"}, {"width", 1.4}, {"dash", "dash"}}}});
  report.AddFigure(figure);
}

}  // namespace ambrig
