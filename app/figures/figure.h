#pragma once
/// Figures of a report: Plotly traces and layout, built by small functions.
///
/// A figure is a grid of panels (numbered from 0, row by row) with one caption in words. Values are
/// given in the unit that the axis title names. Colours are names that the page resolves for light,
/// dark and paper: "@blue @orange @green @red @purple @sky @brown @gray @ink @muted @faint", with
/// an alpha in per cent after a slash: "@blue/20". The first eight are distinguishable for
/// colour-blind readers; lines beyond four differ in dash too (SeriesStyle).
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ambrig {

struct Figure {
  std::string caption;
  int height = 380;  // [px]
  nlohmann::json traces = nlohmann::json::array();
  nlohmann::json layout = nlohmann::json::object();
  int panels = 1;
  double narrow = 0;  // [px] greatest width of the plot, 0 = as wide as the page
};

struct Grid {
  int rows = 1, columns = 1;
  bool shared_x = true;             // panels of one column zoom together, x numbers at the bottom
  std::vector<std::string> titles;  // one per panel, may be empty
  int panel_height = 0;             // [px]; 0: 320 for one row, else 190
};

struct Style {
  std::string color = "@blue";
  double width = 1.5;          // [px]
  std::string dash = "solid";  // "dash", "dot"
  bool markers = false;        // points instead of a line
  bool steps = false;          // held until the next point
  bool legend = true;
  double size = 5;  // of markers [px]
};
/// The k-th line of a figure: blue, orange, green, purple solid, then the same dashed.
Style SeriesStyle(int k);

Figure MakeFigure(std::string caption, const Grid& grid = {});
/// Titles with unit, e.g. "time [s]", "x [µm]"; ranges where the automatic ones will not do.
void SetAxes(Figure& figure, int panel, const std::string& x, const std::string& y,
             std::optional<std::array<double, 2>> x_range = {},
             std::optional<std::array<double, 2>> y_range = {});
/// One unit of x is as long as one of y: orbits, drawings, root loci.
void EqualAspect(Figure& figure, int panel);
void LogAxes(Figure& figure, int panel, bool x, bool y);

/// Decimated to kMaxPoints when longer.
void AddLine(Figure& figure, int panel, const std::string& name, std::span<const double> x,
             std::span<const double> y, const Style& style = {});
/// Decimated so that the greatest excursion stays.
void AddOrbit(Figure& figure, int panel, const std::string& name, std::span<const double> x,
              std::span<const double> y, const Style& style = {});
/// Shaded between low(x) and high(x): an expected band. Not decimated; where an edge is NaN the
/// shade runs straight to the next point.
void AddBand(Figure& figure, int panel, const std::string& name, std::span<const double> x,
             std::span<const double> low, std::span<const double> high,
             const std::string& color = "@green");
void AddBars(Figure& figure, int panel, const std::string& name,
             const std::vector<std::string>& labels, std::span<const double> heights,
             const std::string& color = "@blue");
/// Counts in equal bins between the least and the greatest value; NaN left out.
void AddHistogram(Figure& figure, int panel, const std::string& name,
                  std::span<const double> values, int bins, const std::string& color = "@blue");
/// values[row][column]; numbers are printed into the cells when `print` names their digits (> 0).
void AddHeatmap(Figure& figure, int panel, const std::vector<std::string>& columns,
                const std::vector<std::string>& rows,
                const std::vector<std::vector<double>>& values, const std::string& bar_title,
                int print = 3);
void AddCircle(Figure& figure, int panel, double x, double y, double radius,
               const std::string& line, const std::string& fill = "", double width = 1.5,
               const std::string& dash = "solid");
void AddText(Figure& figure, int panel, double x, double y, const std::string& text,
             const std::string& color = "@ink", int size = 11);
/// A shaded interval of x with its name inside at the top: stages of a run.
void AddRegion(Figure& figure, int panel, double x0, double x1, const std::string& label,
               const std::string& color);
/// A horizontal line: a limit, with its name at the right end.
void AddLevel(Figure& figure, int panel, double y, const std::string& label,
              const std::string& color = "@muted");

/// A vertical line at an instant; labels stand above the top panel, and marks nearer to each other
/// than the text is wide share one label.
struct Mark {
  double x = 0;
  std::string label;
  std::string color = "@red";
};
/// Marks outside `range` (of x, as drawn) are left out.
void AddMarks(Figure& figure, std::span<const Mark> marks, std::array<double, 2> range);

/// "x", "x2", ... and "y", "y2", ... of a panel, for code that adds a trace by hand.
std::string XRef(int panel);
std::string YRef(int panel);
/// Rounded for the page: a file of shortest decimals instead of 17 digits. NaN becomes null.
nlohmann::json Numbers(std::span<const double> values, int digits = 6);

}  // namespace ambrig
