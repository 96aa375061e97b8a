#include "app/figures/ratio_figure.h"

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"

namespace ambrig {

Figure RatioFigure(const std::vector<std::string>& columns, const std::vector<std::string>& rows,
                   const std::vector<std::vector<double>>& values, const std::string& caption,
                   double scale) {
  constexpr std::size_t kReadable = 20;  // columns that leave room for numbers
  Grid grid;
  grid.panel_height = std::clamp(static_cast<int>(rows.size()) * 26, 120, 1400);
  const bool printed = columns.size() <= kReadable;
  double largest = std::max(2.0, scale);
  for (const auto& row : values)
    for (const double v : row)
      largest = std::isfinite(v) && scale == 0 ? std::max(largest, v) : largest;
  std::string note = largest > 10 ? " The colour ends at 10." : "";
  if (!printed) note += " Hover over a cell to read its value.";
  Figure figure = MakeFigure(caption + note, grid);
  AddHeatmap(figure, 0, columns, rows, values, "error / noise", printed ? 3 : 0);
  figure.traces.back().update({{"zmin", 1}, {"zmax", std::min(largest, 10.0)}});
  return figure;
}

}  // namespace ambrig
