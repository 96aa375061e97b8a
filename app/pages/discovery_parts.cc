#include "app/pages/discovery_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/figures/series.h"
#include "app/text/format.h"

namespace ambrig {
namespace {

/// A table of numbers that grows by named rows and columns.
struct RatioTable {
  std::vector<std::string> rows, columns;
  std::vector<std::vector<double>> values;

  void Put(const std::string& row, const std::string& column, double value) {
    const auto r = Place(rows, row), c = Place(columns, column);
    values.resize(rows.size());
    for (auto& v : values) v.resize(columns.size(), std::nan(""));
    values[r][c] = value;
  }
  static std::size_t Place(std::vector<std::string>& names, const std::string& name) {
    const auto at = std::ranges::find(names, name);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    names.push_back(name);
    return names.size() - 1;
  }
};

void AddTable(HtmlReport& report, const RatioTable& table, const std::string& caption,
              double scale) {
  if (!table.rows.empty())
    report.AddFigure(RatioFigure(table.columns, table.rows, table.values, caption, scale));
}

std::string StepName(const LadderStep& s) {
  if (s.added.empty()) return "rig file as it is";
  if (s.added == "parameters") return "+ rig parameters fitted";
  return s.added.starts_with("without") ? s.added : "+ " + s.added;
}

/// Whether records were kept back from the fits; without, the second ratio is that of all, which
/// were fitted.
bool AnyKeptBack(const std::vector<LadderStep>& ladder) {
  return std::ranges::any_of(ladder,
                             [](const LadderStep& s) { return s.ratio_fit != s.ratio_validate; });
}

void LadderFigure(HtmlReport& report, const std::vector<LadderStep>& ladder) {
  Grid grid;
  grid.panel_height = 240;
  Figure figure = MakeFigure(
      std::string("Error over noise after each step of the identification. ") +
          (AnyKeptBack(ladder)
               ? "A step that reduces the error of the fitted records only is overfitting; one "
                 "that reduces that of the unseen records as well generalises."
               : "All records were fitted, so that overfitting would not show.") +
          " At 1 only noise remains.",
      grid);
  std::vector<std::string> names;
  std::vector<double> fit, unseen;
  for (const LadderStep& s : ladder) {
    names.push_back(StepName(s));
    fit.push_back(s.ratio_fit);
    unseen.push_back(s.ratio_validate);
  }
  AddBars(figure, 0, "fitted records", names, fit, "@sky");
  if (AnyKeptBack(ladder)) AddBars(figure, 0, "unseen records", names, unseen, "@blue");
  for (auto& bars : figure.traces) {
    bars["texttemplate"] = "%{y:.3~g}";
    bars["textposition"] = "outside";
    bars["cliponaxis"] = false;
  }
  SetAxes(figure, 0, "", "error / noise");
  AddLevel(figure, 0, 1, "noise", "@green");
  figure.layout["annotations"].back().update(
      {{"xanchor", "left"}, {"yanchor", "middle"}});  // beside the last bar, not on it
  figure.layout["margin"]["r"] = 56;
  report.AddFigure(figure);
}

}  // namespace

double LargestRatio(const Comparison& c) {
  double largest = 0;
  for (const RecordComparison& r : c.records)
    for (const ChannelError& e : r.channels) largest = std::max(largest, e.ratio);
  return largest;
}

void AddReadingHelp(HtmlReport& report, bool fitted) {
  report.Text(
      "How to read the numbers: the **error over noise** is the rms of measured less model, "
      "divided by the rms that "
      "the measurement noise alone makes in that channel after its way round the control loop. "
      "**1** means that nothing is left to "
      "explain; 3 means an error three times as large as the noise. " +
      std::string(fitted ? "Records are *fitted* (parameters were adjusted to them) or *unseen* "
                           "(kept back, only used to judge). A cause is believed when the error "
                           "falls on the unseen records too."
                         : "Nothing was fitted here. `ambrig explain` will adjust parameters to "
                           "the records *to be fitted* and judge by the *unseen* ones."));
}

void AddRatioMap(HtmlReport& report, const Comparison& c, const std::string& caption,
                 double scale) {
  RatioTable table;
  for (const RecordComparison& r : c.records)
    for (const ChannelError& e : r.channels)
      table.Put(ShortName(r.data) + (r.validate ? " (unseen)" : ""), e.channel, e.ratio);
  AddTable(report, table, caption, scale);
}

void AddRatioMap(HtmlReport& report, const CaseModel& model, const std::vector<double>& residual,
                 const std::string& caption, double scale) {
  RatioTable table;
  for (const Target& t : model.targets()) {
    const CaseRecord& r = model.data().records[t.record];
    table.Put(ShortName(r.data_file) + (r.validate ? " (unseen)" : ""), ChannelName(model, t),
              TargetRatio(model, residual, t));
  }
  AddTable(report, table, caption, scale);
}

void AddLadder(HtmlReport& report, const std::vector<LadderStep>& ladder) {
  if (ladder.empty()) return;
  LadderFigure(report, ladder);
  std::vector<std::vector<Cell>> rows;
  double last = std::nan("");
  for (const LadderStep& s : ladder) {
    const double change = std::isfinite(last) && last > 0 ? s.ratio_validate / last - 1 : 0,
                 share = std::round(100 * change) + 0.0;  // no "-0 %"
    rows.push_back({StepName(s), fmt::format("{:.3f}", s.ratio_fit),
                    fmt::format("{:.3f}", s.ratio_validate),
                    Cell(std::isfinite(last) ? fmt::format("{:+.0f} %", share) : "",
                         share < 0 ? "ok" : "muted")});
    last = s.ratio_validate;
  }
  const bool unseen = AnyKeptBack(ladder);
  if (!unseen)
    for (std::vector<Cell>& row : rows) row.erase(row.begin() + 2);
  std::vector<std::string> columns{"model", "fitted records"};
  if (unseen) columns.push_back("unseen records");
  columns.push_back(unseen ? "change on unseen" : "change");
  report.Table(columns, rows, "Error over noise, step by step.");
}

std::string BlockText(const Comparison& c) {
  struct Worst {
    double ratio = 0;
    std::string block, record;
  };
  std::vector<Worst> blocks;  // each block where it errs most
  double whole = 0;
  for (const RecordComparison& r : c.records) {
    if (!r.blocks.empty()) whole = std::max(whole, r.ratio);
    for (const auto& [block, ratio] : r.blocks) {
      auto at = std::ranges::find(blocks, block, &Worst::block);
      if (at == blocks.end()) at = blocks.insert(at, Worst{0, block, ""});
      if (ratio > at->ratio) *at = {ratio, block, ShortName(r.data)};
    }
  }
  if (blocks.empty()) return "";
  std::ranges::stable_sort(blocks, std::greater(), &Worst::ratio);
  const auto& [largest, name, record] = blocks.front();
  if (largest > 1.5) {
    std::string text =
        fmt::format("The largest error of a block is {:.2f} times its noise, of the {} block in {}",
                    largest, name, record);
    if (blocks.size() > 1)
      text += fmt::format("; next comes {} with {:.2f}", blocks[1].block, blocks[1].ratio);
    // a block that errs far less than the loop round it does not explain the loop
    if (whole > 3 * largest)
      text += fmt::format(
          ". The whole model is {:.2f} times the noise off, far more: the blocks alone do not tell "
          "where it comes from, ambrig explain looks at the whole loop",
          whole);
    return text + ".";
  }
  if (whole < 1.5)
    return fmt::format("No block stands out: the largest is {} with {:.2f} times its noise.", name,
                       largest);
  return fmt::format(
      "The blocks do not tell where the error sits: the whole model is {:.2f} times the noise off, "
      "but no block alone ({} at most, {:.2f} times its own noise). Fed with measured, noisy "
      "inputs a block is blunter than the loop, in which a small error accumulates; ambrig explain "
      "looks at the whole loop.",
      whole, name, largest);
}

std::string List(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += "- " + line + "\n";
  return out;
}

std::string EffectName(const EffectInstance& e) {
  return NameAtTarget(e.name + (e.label.empty() ? "" : " (" + e.label + ")"), e.target);
}

std::string ValueText(double value, double sd, const std::string& unit) {
  if (!(sd > 0) || !std::isfinite(sd)) return FormatSi(value, unit);
  const bool prefixed =
      FormatSi(1e3, unit).find('k') != std::string::npos && unit.find('k') == std::string::npos;
  const double largest = std::max(std::abs(value), sd);
  const DisplayUnit shown =
      prefixed ? ChooseUnit(largest, unit) : DisplayUnit{1, unit == "-" ? "" : unit};
  // As many decimals as the sd has in its first two digits.
  const int decimals =
      std::clamp(1 - static_cast<int>(std::floor(std::log10(sd * shown.factor))), 0, 9);
  return fmt::format("{:.{}f} ± {:.{}f}{}{}", value * shown.factor, decimals, sd * shown.factor,
                     decimals, shown.name.empty() ? "" : "\u00a0", shown.name);
}

std::string ParametersText(const EffectInstance& e) {
  std::string out;
  for (std::size_t k = 0; k < e.table.size(); ++k)
    out += (k == 0 ? "" : ", ") + e.table[k].name + " = " +
           ValueText(e.values[k], k < e.sd.size() ? e.sd[k] : 0, e.table[k].unit);
  return out;
}

}  // namespace ambrig
