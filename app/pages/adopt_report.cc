// The report of `ambrig adopt`: what the effect changed.
#include <fmt/format.h>

#include <algorithm>

#include "app/figures/bench_figures.h"
#include "app/figures/residual_figures.h"
#include "app/pages/discovery_parts.h"
#include "app/pages/discovery_report.h"

namespace ambrig {
namespace {

void AddWords(HtmlReport& report, const Comparison& before, const Comparison& after,
              const std::vector<LadderStep>& ladder) {
  const std::string what =
      ladder.empty() || ladder.back().added.empty() || ladder.back().added == "parameters"
          ? "The effects of the rig file"
          : ladder.back().added;
  const std::string numbers = fmt::format(
      "error over noise {:.2f} before, **{:.2f}** after ({})", before.ratio, after.ratio,
      before.ratio_validate > 0 ? fmt::format("unseen records: {:.2f} before, **{:.2f}** after",
                                              before.ratio_validate, after.ratio_validate)
                                : "no record is kept unseen");
  const double was = before.ratio_validate > 0 ? before.ratio_validate : before.ratio,
               is = after.ratio_validate > 0 ? after.ratio_validate : after.ratio;
  if (is >= 0.99 * was)
    report.Verdict(Verdict::kWarn,
                   fmt::format("**{} did not reduce the error**: {}. Remove it from the rig file.",
                               what, numbers));
  else if (is < 1.1)
    report.Verdict(
        Verdict::kOk,
        fmt::format("**{} explains the measurements within their noise**: {}.", what, numbers));
  else
    report.Verdict(Verdict::kInfo,
                   fmt::format("**{} reduces the error, but a residual remains**: {}. Run `ambrig "
                               "explain` with the new rig file to examine it.",
                               what, numbers));
  AddReadingHelp(report, true);
}

std::vector<std::vector<Cell>> EffectRows(const RigParameters& rig) {
  std::vector<std::vector<Cell>> rows;
  for (const EffectInstance& e : rig.effects)
    for (std::size_t k = 0; k < e.table.size(); ++k)
      rows.push_back({k == 0 ? EffectName(e) : "", e.table[k].name,
                      ValueText(e.values[k], k < e.sd.size() ? e.sd[k] : 0, e.table[k].unit),
                      e.table[k].doc});
  return rows;
}

/// The channels that gained most, of any record.
std::vector<Target> MostImproved(const CaseModel& model, const std::vector<double>& before,
                                 const std::vector<double>& after, std::size_t count) {
  std::vector<std::pair<double, const Target*>> order;
  for (const Target& t : model.targets())
    if (OverTime(model.data().records[t.record]))
      order.emplace_back(TargetRatio(model, before, t) - TargetRatio(model, after, t), &t);
  std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Target> out;
  for (const auto& [gain, t] : order) {
    const bool known = std::ranges::any_of(
        out, [&](const Target& o) { return ChannelName(model, o) == ChannelName(model, *t); });
    if (out.size() < count && gain > 0.05 && !known && t->count >= 64) out.push_back(*t);
  }
  return out;
}

void AddBeforeAfter(HtmlReport& report, const CaseModel& model, const Comparison& before,
                    const Comparison& after) {
  report.Heading("Before and after");
  AddRatioMap(report, before, "Before: error over noise of every channel in every record.");
  AddRatioMap(report, after,
              "After, with the new rig file. Cells that stay dark are not explained by the adopted "
              "effects.",
              LargestRatio(before));
  if (before.predicted.size() != model.size() || after.predicted.size() != model.size()) return;
  const std::vector<Target> gained =
      MostImproved(model, Residual(model, before.predicted), after.residual, 3);
  for (std::size_t r = 0; r < model.data().records.size(); ++r)
    for (const Figure& f : BenchFigures(
             model,
             {{"before", "@orange", &before.predicted}, {"after", "@green", &after.predicted}}, r))
      report.AddFigure(f);
  if (gained.empty()) return;
  report.AddFigure(
      TimeFigure(model, gained,
                 {{"before", "@orange", &before.predicted}, {"after", "@green", &after.predicted}},
                 "Channels with the largest improvement. Top: whole record; middle: stretch with "
                 "the largest error of the old model; bottom: errors, noise in grey."));
  report.AddFigure(SpectrumFigure(
      model, gained,
      {{"model before", "@orange", &before.predicted}, {"model after", "@green", &after.predicted}},
      {},
      "Spectra of the errors before and after; grey: the noise's rms spread evenly over "
      "frequency."));
}

}  // namespace

void WriteAdoptReport(const CaseModel& model, const Comparison& before, const Comparison& after,
                      const std::vector<LadderStep>& ladder, const std::string& path) {
  HtmlReport report("Effect adopted", model.data().file);
  report.Heading("Result");
  AddWords(report, before, after, ladder);
  report.Heading("Error after each step");
  AddLadder(report, ladder);
  const auto rows = EffectRows(model.data().rig);
  if (!rows.empty()) {
    report.Heading("Effects of the new rig file");
    report.Table({"effect", "parameter", "value ± sd", "meaning"}, rows,
                 "The effects in the new rig file.");
  }
  AddBeforeAfter(report, model, before, after);
  report.Heading("Residual");
  report.Text(List(after.words));
  report.Write(path);
}

}  // namespace ambrig
