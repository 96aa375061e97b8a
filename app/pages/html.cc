#include "app/pages/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/figures/series.h"
#include "app/pages/assets.h"
#include "app/text/format.h"
#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/parameters.h"

namespace ambrig {
namespace {

constexpr std::string_view kHead =
    R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="ambrig">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; )"
    R"(script-src 'unsafe-inline'; img-src data: blob:; font-src data:; base-uri 'none'; form-action 'none'">
)";

constexpr std::size_t kWideTable = 7;  // more columns are set smaller and wrap
constexpr int kLegendHeight = 28;      // [px], of the 84 below a figure (MakeFigure)

const char* StyleName(Verdict kind) {
  switch (kind) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kWarn:
      return "warn";
    case Verdict::kFail:
      return "fail";
    case Verdict::kInfo:
      break;
  }
  return "info";
}

bool LooksNumeric(std::string_view text) {
  if (text.starts_with("−")) text.remove_prefix(std::string_view("−").size());
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  // "3 of 8" and "2.1 mm" are numbers to a reader's eye, "3dof-rotor" is not.
  std::size_t end = text.find_first_not_of("0123456789.,");
  if (end != std::string_view::npos && end + 2 < text.size() && text[end] == 'e' &&
      (text[end + 1] == '-' || text[end + 1] == '+'))
    end = text.find_first_not_of("0123456789", end + 2);
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) != 0 &&
         (end == std::string_view::npos ||
          std::isalpha(static_cast<unsigned char>(text[end])) == 0);
}

std::vector<std::string> HtmlLines(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

// One line needs no legend, its axis says what it is; the room below is given back.
Figure WithLegendWhenNeeded(Figure figure) {
  const auto named = std::ranges::count_if(
      figure.traces, [](const auto& trace) { return trace.value("showlegend", true); });
  figure.layout["showlegend"] = named > 1;
  nlohmann::json& bottom = figure.layout["margin"]["b"];
  if (named <= 1 && bottom.get<double>() >= kLegendHeight * 2) {
    bottom = bottom.get<double>() - kLegendHeight;
    figure.height -= kLegendHeight;
  }
  if (named > 7) {  // wraps into a second line on paper
    bottom = bottom.get<double>() + 20;
    figure.height += 20;
  }
  return figure;
}

// JSON inside <script>: "<" may not appear, or "</script>" in a caption would end it.
std::string ScriptJson(const nlohmann::json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

HtmlReport::HtmlReport(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void HtmlReport::Heading(std::string_view text, int level) {
  Require(level == 2 || level == 3, "heading level 2 or 3");
  const std::string id = fmt::format("s{}", ++sections_);
  body_ += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level, id, InlineMarkup(text));
  contents_ +=
      fmt::format("<li class=\"l{}\"><a href=\"#{}\">{}</a></li>\n", level, id, InlineMarkup(text));
}

void HtmlReport::Text(std::string_view text) {
  std::vector<std::string> block;
  const auto flush = [&] {
    if (block.empty()) return;
    const bool list = std::ranges::all_of(block, [](const auto& l) { return l.starts_with("- "); });
    body_ += list ? "<ul>\n" : "<p>";
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (list)
        body_ += "<li>" + InlineMarkup(block[i].substr(2)) + "</li>\n";
      else
        body_ += (i > 0 ? " " : "") + InlineMarkup(block[i]);
    }
    body_ += list ? "</ul>\n" : "</p>\n";
    block.clear();
  };
  for (const std::string& line : HtmlLines(text)) {
    const bool item = line.starts_with("- ");
    if (line.empty() || (!block.empty() && item != block.back().starts_with("- "))) flush();
    if (!line.empty()) block.push_back(line);
  }
  flush();
}

void HtmlReport::Verdict(enum Verdict kind, std::string_view text) {
  body_ += fmt::format("<p class=\"verdict {}\">{}</p>\n", StyleName(kind), InlineMarkup(text));
}

void HtmlReport::KeyValues(const std::vector<std::pair<std::string, std::string>>& pairs) {
  body_ += "<dl class=\"keys\">\n";
  for (const auto& [key, value] : pairs)
    body_ +=
        fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", InlineMarkup(key), InlineMarkup(value));
  body_ += "</dl>\n";
}

void HtmlReport::Table(const std::vector<std::string>& columns,
                       const std::vector<std::vector<Cell>>& rows, std::string_view caption) {
  body_ += columns.size() > kWideTable ? "<div class=\"table wide\"><table>\n"
                                       : "<div class=\"table\"><table>\n";
  if (!caption.empty()) body_ += fmt::format("<caption>{}</caption>\n", InlineMarkup(caption));
  body_ += "<thead><tr>";
  for (const std::string& c : columns)
    body_ += fmt::format("<th scope=\"col\">{}</th>", InlineMarkup(c));
  body_ += "</tr></thead>\n<tbody>\n";
  std::vector<char> of_numbers(columns.size());
  for (const auto& row : rows) {
    Require(row.size() == columns.size(), "a cell per column");
    for (std::size_t c = 0; c < row.size(); ++c)
      if (LooksNumeric(row[c].text)) of_numbers[c] = 1;
  }
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string& text = row[c].text;
      const bool dash = of_numbers[c] && (text == "-" || text == "–");  // below its numbers
      body_ += fmt::format("<td class=\"{} {}\">{}</td>", HtmlEscape(row[c].style),
                           LooksNumeric(text) || dash ? "num" : "", InlineMarkup(text));
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlReport::Code(std::string_view text) {
  body_ += fmt::format("<pre><code>{}</code></pre>\n", HtmlEscape(text));
}

void HtmlReport::BeginDetails(std::string_view summary) {
  body_ += fmt::format("<details><summary>{}</summary>\n", InlineMarkup(summary));
}

void HtmlReport::EndDetails() { body_ += "</details>\n"; }

void HtmlReport::AddFigure(const Figure& given) {
  const Figure figure = WithLegendWhenNeeded(given);
  const int number = ++figures_;
  const std::string narrow =
      figure.narrow > 0 ? fmt::format(";max-width:{:.0f}px", figure.narrow) : std::string();
  body_ += fmt::format(
      "<figure id=\"f{0}\"><div class=\"plot\" style=\"height:{1}px{2}\"></div>\n"
      "<figcaption><b>Figure {0}.</b> {3}</figcaption>\n"
      "<script type=\"application/json\">{4}</script></figure>\n",
      number, figure.height, narrow, InlineMarkup(figure.caption),
      ScriptJson({{"data", figure.traces}, {"layout", figure.layout}}));
}

void HtmlReport::TimeSeries(const std::string& caption, const std::string& x_title,
                            const std::string& y_title, const std::vector<Series>& series,
                            std::span<const Mark> marks) {
  Figure figure = MakeFigure(caption);
  SetAxes(figure, 0, x_title, y_title);
  int k = 0;
  std::array<double, 2> range = {kInfinity, -kInfinity};  // of all series
  for (const Series& s : series) {
    AddLine(figure, 0, s.name, s.x, s.y, SeriesStyle(k++));
    if (!s.x.empty()) range = {std::min(range[0], s.x.front()), std::max(range[1], s.x.back())};
  }
  AddMarks(figure, marks, range);
  AddFigure(figure);
}

void HtmlReport::Heatmap(const std::string& caption, const std::vector<std::string>& columns,
                         const std::vector<std::string>& rows,
                         const std::vector<std::vector<double>>& values,
                         const std::string& bar_title) {
  Grid grid;
  grid.panel_height = std::clamp(static_cast<int>(rows.size()) * 26, 120, 1400);
  Figure figure = MakeFigure(caption, grid);
  AddHeatmap(figure, 0, columns, rows, values, bar_title);
  AddFigure(figure);
}

void HtmlReport::OrbitPlot(const std::string& caption, const std::string& unit, double clearance,
                           const std::vector<Series>& orbits) {
  Grid grid;
  grid.panel_height = 420;
  Figure figure = MakeFigure(caption, grid);
  figure.narrow = 560;
  const std::array<double, 2> range = {-1.15 * clearance, 1.15 * clearance};
  SetAxes(figure, 0, "x [" + unit + "]", "y [" + unit + "]", range, range);
  EqualAspect(figure, 0);
  AddCircle(figure, 0, 0, 0, clearance, "@ink", "", 1.5, "dash");
  int k = 0;
  for (const Series& s : orbits) AddOrbit(figure, 0, s.name, s.x, s.y, SeriesStyle(k++));
  AddFigure(figure);
}

std::string HtmlReport::Html() const {
  std::string out(kHead);
  out += fmt::format("<title>{}</title>\n<style>\n", HtmlEscape(title_));
  out += ReportCss();
  out += "</style>\n</head>\n<body>\n";
  out += fmt::format("<nav aria-label=\"contents\"><p>{}</p><ol>\n{}</ol></nav>\n<main>\n",
                     HtmlEscape(title_), contents_);
  out += fmt::format("<header><h1>{}</h1><p class=\"subtitle\">{}</p></header>\n",
                     InlineMarkup(title_), InlineMarkup(subtitle_));
  out +=
      "<noscript><p class=\"verdict warn\">The figures need JavaScript; it is inside this file, "
      "nothing is loaded.</p></noscript>\n";
  out += body_;
  out += "</main>\n";
  if (figures_ > 0) {  // a page of text and tables stays small
    out += "<script>";
    out += PlotlyJs();
    out += "</script>\n";
  }
  out += "<script>\n";
  out += ReportJs();
  out += "</script>\n</body>\n</html>\n";
  return out;
}

void HtmlReport::Write(const std::filesystem::path& path) const {
  std::error_code folder;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), folder);
  if (folder) ThrowCannotWrite(path.string(), folder.value());
  WriteFileAtomically(path.string(), Html());
}

}  // namespace ambrig
