#pragma once
/// One self-contained HTML file: text, tables and figures with the plotting library inside it.
/// Works offline, in light, dark and print; its content policy forbids it to load anything.
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/figures/figure.h"
#include "app/text/verdict.h"

namespace ambrig {

/// A table cell; `style` is "" (numbers are aligned right by themselves), "ok", "warn", "fail" or
/// "muted".
struct Cell {
  Cell(std::string t, std::string s = "") : text(std::move(t)), style(std::move(s)) {}  // NOLINT
  Cell(const char* t, std::string s = "") : text(t), style(std::move(s)) {}             // NOLINT
  std::string text, style;
};

class HtmlReport {
 public:
  HtmlReport(std::string title, std::string subtitle);

  /// level 2 is a section (in the table of contents), level 3 a part of one.
  void Heading(std::string_view text, int level = 2);
  /// A paragraph; an empty line starts another, lines that all begin with "- " make a list;
  /// **strong**, *stressed*, `code`. Everything else is escaped.
  void Text(std::string_view text);
  void Verdict(enum Verdict kind, std::string_view text);
  void KeyValues(const std::vector<std::pair<std::string, std::string>>& pairs);
  void Table(const std::vector<std::string>& columns, const std::vector<std::vector<Cell>>& rows,
             std::string_view caption = {});
  /// Verbatim text: a TOML file, a log.
  void Code(std::string_view text);
  /// Something long that not everybody wants: folded until opened (open in print).
  void BeginDetails(std::string_view summary);
  void EndDetails();
  void AddFigure(const Figure& figure);

  // The three most wanted figures in one call each; x and y in the unit of the axis title.
  struct Series {
    std::string name;
    std::span<const double> x, y;
  };
  void TimeSeries(const std::string& caption, const std::string& x_title,
                  const std::string& y_title, const std::vector<Series>& series,
                  std::span<const Mark> marks = {});
  void Heatmap(const std::string& caption, const std::vector<std::string>& columns,
               const std::vector<std::string>& rows, const std::vector<std::vector<double>>& values,
               const std::string& bar_title);
  /// Orbits inside a clearance circle.
  void OrbitPlot(const std::string& caption, const std::string& unit, double clearance,
                 const std::vector<Series>& orbits);

  std::string Html() const;
  /// Complete or not at all. @throws InputError when it cannot be written.
  void Write(const std::filesystem::path& path) const;

 private:
  std::string title_, subtitle_, body_, contents_;
  int sections_ = 0, figures_ = 0;
};

}  // namespace ambrig
