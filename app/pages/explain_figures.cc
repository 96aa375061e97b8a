#include "app/pages/explain_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "app/figures/bench_figures.h"
#include "app/figures/response_figures.h"
#include "core/record/channels.h"
#include "discovery/model/floor.h"

namespace ambrig {
namespace {

std::vector<std::string> WorstPlaces(const CaseModel& model, const std::vector<double>& residual) {
  std::vector<std::pair<double, const Target*>> all;
  for (const Target& t : model.targets()) all.emplace_back(TargetRatio(model, residual, t), &t);
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> out;
  for (const auto& [ratio, t] : all) {
    if (out.size() == 5 || ratio < 1.15) break;
    const CaseRecord& r = model.data().records[t->record];
    out.push_back(fmt::format("**{}** ({}) in {} (*{}*): {:.1f} times the noise",
                              ChannelName(model, *t), ChannelWords(ChannelName(model, *t)),
                              ShortName(r.data_file), r.scenario.name, ratio));
  }
  return out;
}

/// Channels whose error fell most, each name and kind once: unseen records first when they tell.
std::vector<Target> MostTelling(const ExplainScene& s, std::size_t count) {
  std::vector<std::pair<double, const Target*>> order;
  for (const Target& t : s.model.targets()) {
    if (!OverTime(s.model.data().records[t.record])) continue;
    const double gain =
        TargetRatio(s.model, s.plain_residual, t) - TargetRatio(s.model, s.final_residual, t);
    order.emplace_back(s.model.data().records[t.record].validate ? 1.3 * gain : gain, &t);
  }
  std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Target> out;
  for (const auto& [gain, t] : order) {
    const std::string_view kind = ChannelWords(ChannelName(s.model, *t));
    const bool known = std::ranges::any_of(
        out, [&](const Target& o) { return ChannelWords(ChannelName(s.model, o)) == kind; });
    if (out.size() < count && gain > 0.1 && !known && t->count >= 64) out.push_back(*t);
  }
  return out;
}

std::string FinalName(const Explanation& e) {
  if (e.adopted.empty()) return "fitted model";
  std::string out = "model with ";
  for (std::size_t k = 0; k < e.adopted.size(); ++k)
    out += (k > 0 ? " and " : "") + EffectName(e.adopted[k]);
  return out;
}

void AddSignatures(HtmlReport& report, const ExplainScene& s, const Target& t) {
  std::vector<NamedPrediction> all = {{"rig file", "@orange", &s.plain}};
  std::deque<std::vector<double>> predictions;  // stay where they are
  for (const RankedEffect& r : s.explanation.ranking) {
    if (all.size() >= 5 || !std::isfinite(r.fit.ratio_fit)) continue;
    auto predicted = s.model.Predict(r.fit.hypothesis);
    if (!predicted) continue;
    predictions.push_back(std::move(*predicted));
    all.push_back({EffectName(r.effect), "@orange", &predictions.back()});
  }
  if (all.size() < 2) return;
  report.AddFigure(SignatureFigure(
      s.model, t, all,
      fmt::format("Signatures: what each candidate (with the rig parameters fitted beside it) adds "
                  "to the plain model in {} of {}, over what the plain model leaves unexplained. "
                  "The signature of the true effect follows the black line everywhere; those of "
                  "others follow it only in places. The best-ranked is green.",
                  ChannelName(s.model, t), ShortName(s.model.data().records[t.record].data_file))));
}

/// Frequency responses and tables before and after; whether there are any.
bool AddBench(HtmlReport& report, const ExplainScene& s,
              const std::vector<NamedPrediction>& models) {
  bool any = false;
  for (std::size_t r = 0; r < s.model.data().records.size(); ++r)
    for (const Figure& f : BenchFigures(s.model, models, r)) {
      report.AddFigure(f);
      any = true;
    }
  return any;
}

}  // namespace

ExplainScene::ExplainScene(const Case& c, const Explanation& e) : explanation(e), model(c) {
  try {
    const Hypothesis base = Hypothesis::Base(c.rig);
    if (e.noise.estimated) model.noise_model = e.noise;
    model.LimitToHeld(base);
    plain = FindFloor(model, base).clean;
    noise = NoiseSample(model, base, plain);
  } catch (const InputError&) {
    return;  // the rig file's model loses its rotor: the words alone remain
  }
  plain_residual = Residual(model, plain);
  const auto last =
      e.final_fit.predicted.empty() ? std::nullopt : model.Predict(e.final_fit.hypothesis);
  final_prediction = last ? *last : plain;
  final_residual = Residual(model, final_prediction);
  usable = true;
}

namespace {

/// The channels with the largest errors below `head`, or `none`.
void AddWorstPlaces(HtmlReport& report, const CaseModel& model, const std::vector<double>& residual,
                    const std::string& none, const std::string& head) {
  const auto worst = WorstPlaces(model, residual);
  report.Text(worst.empty() ? none : head + "\n\n" + List(worst));
}

}  // namespace

void AddPlainFailure(HtmlReport& report, const ExplainScene& s) {
  report.Heading("Errors of the model of the rig file");
  if (!s.usable) {
    report.Text(
        "The model of the rig file loses levitation in these records; no error can be shown.");
    return;
  }
  AddWorstPlaces(report, s.model, s.plain_residual, "Nowhere by more than 15 % of the noise.",
                 "The rig file as it is, beside the measurements; worst first:");
  AddRatioMap(report, s.model, s.plain_residual,
              "Error over noise of the plain model, every channel (columns: position readings x, "
              "y; coil currents i; set-points s; bus) in every record (rows).");
  if (const auto map = FrequencySpeedMap(
          s.model, s.plain, s.noise,
          "The same error in bands of frequency, records by speed; all channels together."))
    report.AddFigure(*map);
}

void AddWhyThatOne(HtmlReport& report, const ExplainScene& s) {
  const bool found = s.explanation.verdict == ExplanationVerdict::kEffect;
  report.Heading(found ? "Evidence for the accepted effect" : "Change by the parameter fit");
  if (!s.usable) return;
  const std::vector<Target> telling = MostTelling(s, 3);
  const std::string name = FinalName(s.explanation);
  const std::vector<NamedPrediction> both = {{"rig file", "@orange", &s.plain},
                                             {name, "@green", &s.final_prediction}};
  const bool bench = AddBench(report, s, both);
  if (telling.empty()) {
    if (!bench)
      report.Text(
          "No figure: neither parameters nor effects reduced the error of any channel noticeably.");
    return;
  }
  report.AddFigure(
      TimeFigure(s.model, telling, both,
                 "The channels with the largest change, one of each kind. Top: the whole record. "
                 "Middle: the stretch with the largest error of the plain model. Bottom: the "
                 "errors; what lies inside the grey band is noise."));
  if (found) AddSignatures(report, s, telling.front());
  report.AddFigure(SpectrumFigure(
      s.model, telling, both, s.noise,
      "Spectra of those errors. The green line should lie on the grey one, the noise alone."));
}

void AddWhatIsLeft(HtmlReport& report, const ExplainScene& s) {
  if (!s.usable) return;
  report.Heading("Residual");
  AddWorstPlaces(report, s.model, s.final_residual,
                 "Nothing: no channel of any record errs by more than 15 % over its noise.",
                 "Largest remaining errors after all fits:");
  AddRatioMap(report, s.model, s.final_residual,
              "Error over noise after everything that was fitted; compare with the same map of the "
              "plain model above, in the same colours.",
              WorstRatio(s.model, s.plain_residual, Which::kAll));
}

}  // namespace ambrig
