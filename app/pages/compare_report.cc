// The report of `ambrig compare`: where the model fails, in words and pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/figures/bench_figures.h"
#include "app/figures/residual_figures.h"
#include "app/figures/response_figures.h"
#include "app/pages/discovery_parts.h"
#include "app/pages/discovery_report.h"
#include "app/text/format.h"
#include "core/record/channels.h"

namespace ambrig {
namespace {

/// What the sections of this report look at.
struct View {
  const CaseModel& model;
  const Comparison& comparison;
  std::vector<double> noise;
};

std::string BlockMeaning(const std::string& block) {
  static const std::map<std::string, std::string> kMeaning = {
      {"controller",
       "measured readings in, set-points out: filters, gains, delay of the controller"},
      {"coil",
       "measured set-points and readings in, currents out: amplifier, inductance, iron, current "
       "sensors"},
      {"force", "measured currents in, load cells out: magnetic force of the clamped rotor"},
      {"rotor",
       "measured currents and readings in, unmodelled force out: forces and motion of the rotor"},
      {"sensor", "the clamped position in, readings out: position sensors"}};
  const auto at = kMeaning.find(block);
  return at == kMeaning.end() ? "" : at->second;
}

Cell RatioCell(double ratio) {
  if (!std::isfinite(ratio)) return {"–"};
  return {fmt::format("{:.2f}", ratio), ratio > 1.5 ? "fail" : ratio > 1.15 ? "warn" : "ok"};
}

void AddComparisonVerdict(HtmlReport& report, const Comparison& c) {
  if (!std::isfinite(c.ratio)) {
    report.Verdict(Verdict::kWarn, "**Nothing is compared**: no row of any record counts.");
    return;
  }
  const double unseen = c.ratio_validate > 0 ? c.ratio_validate : c.ratio;
  const std::string numbers =
      c.ratio_validate > 0
          ? fmt::format(
                "error over noise {:.2f} over all records ({:.2f} on those that explain "
                "fits, {:.2f} on the unseen)",
                c.ratio, c.ratio_fit, c.ratio_validate)
          : fmt::format("error over noise {:.2f} over all records (none is kept unseen)", c.ratio);
  if (std::max(unseen, c.ratio) < 1.1)
    report.Verdict(Verdict::kOk,
                   "**Model and measurement agree within the noise**: " + numbers + ".");
  else
    report.Verdict(
        c.ratio < 2 ? Verdict::kWarn : Verdict::kFail,
        "**The model does not explain the measurement within its noise**: " + numbers + ".");
}

/// The words of a comparison name data files with their folders; a reader wants the record.
std::vector<std::string> ShortWords(const Comparison& c) {
  std::vector<std::string> out = c.words;
  for (std::string& word : out)
    for (const RecordComparison& r : c.records)
      if (const std::size_t at = word.find(r.data); at != std::string::npos && !r.data.empty()) {
        word.replace(at, r.data.size(), ShortName(r.data));
        break;
      }
  return out;
}

void AddOverview(HtmlReport& report, const View& v) {
  report.Heading("Errors by record and channel");
  AddComparisonVerdict(report, v.comparison);
  AddReadingHelp(report, false);
  report.Text("Largest errors, in descending order:\n\n" + List(ShortWords(v.comparison)));
  if (!v.model.data().notes.empty())
    report.Text("Left out by the data-quality pass:\n\n" + List(v.model.data().notes));
  AddRatioMap(report, v.comparison,
              "Error over noise of every channel in every record. A dark column points to one "
              "sensor or coil, a dark row to "
              "one kind of operation, a dark block to one bearing.");
  if (const auto map =
          FrequencySpeedMap(v.model, v.comparison.predicted, v.noise,
                            "Error over noise in bands of frequency (all channels together); "
                            "run-ups are cut into stretches of speed. What grows with speed "
                            "turns with the rotor; what stays in one band at all speeds is a "
                            "resonance, hum or delay; what is dark at the left is static."))
    report.AddFigure(*map);
}

void AddBlocks(HtmlReport& report, const Comparison& c) {
  std::vector<std::string> names;
  for (const RecordComparison& r : c.records)
    for (const auto& [block, ratio] : r.blocks)
      if (std::ranges::find(names, block) == names.end()) names.push_back(block);
  if (names.empty()) return;
  report.Heading("Errors by block");
  report.Text(
      "Each part of the model was fed with *measured* inputs, so that the error of one does not "
      "spread to the others; its error is divided "
      "by that of a noisy run of the model itself.");
  std::vector<std::string> columns = {"record"}, meaning;
  for (const std::string& name : names) {
    columns.push_back(name);
    meaning.push_back("**" + name + "**: " + BlockMeaning(name));
  }
  std::vector<std::vector<Cell>> rows;
  for (const RecordComparison& r : c.records) {
    std::vector<Cell> row = {fmt::format("{} ({})", ShortName(r.data), r.scenario)};
    for (const std::string& name : names) {
      const auto at = r.blocks.find(name);
      row.push_back(at == r.blocks.end() ? Cell("–", "muted") : RatioCell(at->second));
    }
    rows.push_back(row);
  }
  report.Table(columns, rows,
               "Error of each block over its own noise; – where a record does not determine it.");
  report.Text("**Answer:** " + BlockText(c));
  report.Text(List(meaning));
}

std::string Unit(const CaseRecord& record, const std::string& channel) {
  const Channel* c = record.data.Find(channel);
  return c ? c->unit : "";
}

void AddChannelTable(HtmlReport& report, const CaseRecord& record, const RecordComparison& r) {
  std::vector<ChannelError> all = r.channels;
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.ratio > b.ratio; });
  std::vector<std::vector<Cell>> rows;
  for (const ChannelError& e : all) {
    const std::string unit = Unit(record, e.channel);
    rows.push_back({e.channel, std::string(ChannelWords(e.channel)), FormatSi(e.rms_error, unit),
                    FormatSi(e.noise, unit), RatioCell(e.ratio),
                    std::isfinite(e.nrmse) ? fmt::format("{:.2f} %", 100 * e.nrmse) : "–",
                    fmt::format("{:.2f}", e.whiteness)});
  }
  report.BeginDetails(
      fmt::format("All {} channels of {} in numbers", rows.size(), ShortName(r.data)));
  report.Table({"channel", "kind", "rms error", "noise", "error / noise", "of full scale",
                "neighbour correlation"},
               rows, "Neighbour correlation: 0 for white errors, near 1 for slow ones.");
  report.EndDetails();
}

void AddChannelFigures(HtmlReport& report, const View& v, const std::vector<Target>& worst) {
  const std::vector<NamedPrediction> models = {{"model", "@orange", &v.comparison.predicted}};
  report.AddFigure(TimeFigure(
      v.model, worst, models,
      "The worst channels in time. Top: the whole record. Middle: the stretch where the error is "
      "largest (shaded above). Bottom: measured less model; inside the grey band it is noise."));
  report.AddFigure(
      SpectrumFigure(v.model, worst, models, v.noise,
                     "Spectrum of that error over the noise. Where the curves coincide the model "
                     "is adequate; peaks above the noise are unmodelled."));
  report.AddFigure(WhitenessFigure(
      v.model, worst, models, v.noise,
      "Whiteness of the error: its autocorrelation beside that of the noise alone (coloured by the "
      "control loop). A constant level indicates an offset; slow or oscillating correlation "
      "indicates structure that a model could still explain."));
}

void AddMotionFigures(HtmlReport& report, const View& v, std::size_t record,
                      const std::vector<Target>& worst) {
  if (const auto response = ResponseFigure(v.model, v.comparison.predicted, record))
    report.AddFigure(*response);
  for (const Target& t : worst) {
    if (!IsOfKind(ChannelName(v.model, t), ChannelKind::kReading)) continue;
    if (const auto orders = OrderFigure(v.model, v.comparison.predicted, t))
      report.AddFigure(*orders);
    return;
  }
}

void AddRecord(HtmlReport& report, const View& v, std::size_t record) {
  const RecordComparison& r = v.comparison.records[record];
  report.Heading(fmt::format("{}: {}", ShortName(r.data), r.scenario), 3);
  report.Text(fmt::format("Error over noise **{}**, {} record.", RatioCell(r.ratio).text,
                          r.validate ? "unseen" : "to be fitted"));
  const CaseRecord& data = v.model.data().records[record];
  if (!OverTime(data)) {
    for (const Figure& f :
         BenchFigures(v.model, {{"model", "@orange", &v.comparison.predicted}}, record))
      report.AddFigure(f);
    return AddChannelTable(report, data, r);
  }
  const std::vector<Target> worst = WorstTargets(v.model, v.comparison.residual, record, 3);
  if (!worst.empty() && worst.front().count >= 64) AddChannelFigures(report, v, worst);
  AddMotionFigures(report, v, record,
                   WorstTargets(v.model, v.comparison.residual, record, 1000, 1000));
  AddChannelTable(report, data, r);
}

/// Channels by their worst ratio in any record, two of a kind at most.
std::vector<std::string> WorstNames(const View& v, std::size_t count) {
  std::map<std::string, double> worst;
  for (std::size_t r = 0; r < v.comparison.records.size(); ++r) {
    if (!OverTime(v.model.data().records[r])) continue;
    for (const ChannelError& e : v.comparison.records[r].channels)
      worst[e.channel] = std::max(worst[e.channel], e.ratio);
  }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, ratio] : worst) order.emplace_back(ratio, name);
  std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> out;
  std::map<std::string_view, int> kinds;
  for (const auto& [ratio, name] : order)
    if (out.size() < count && (ratio > 1.05 || out.empty()) && ++kinds[ChannelWords(name)] <= 2)
      out.push_back(name);
  return out;
}

void AddDependence(HtmlReport& report, const View& v) {
  const std::vector<std::string> names = WorstNames(v, 4);
  if (names.empty()) return;
  report.Heading("Dependence of the error");
  report.Text(
      "The shape of these lines is often the law itself: a slope against position is a stiffness, "
      "a kink a contact or a clipped "
      "amplifier, a slope against current a gain, a bend at large currents saturation, growth with "
      "speed something that turns.");
  for (const std::string& name : names)
    if (const auto figure = DependenceFigure(v.model, v.comparison.predicted, name))
      report.AddFigure(*figure);
}

}  // namespace

void WriteCompareReport(const CaseModel& model, const Comparison& comparison,
                        const std::string& path) {
  const View view{model, comparison,
                  NoiseSample(model, Hypothesis::Base(model.data().rig), comparison.predicted)};
  HtmlReport report("Model beside measurement", model.data().file);
  AddOverview(report, view);
  AddBlocks(report, comparison);
  AddDependence(report, view);
  report.Heading("Record by record");
  for (std::size_t r = 0; r < comparison.records.size(); ++r) AddRecord(report, view, r);
  report.Write(path);
}

}  // namespace ambrig
