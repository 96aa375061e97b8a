// The report of `ambrig explain`: the verdict, the evidence, its price, and what to measure next.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/pages/discovery_report.h"
#include "app/pages/explain_figures.h"
#include "app/pages/explain_tables.h"
#include "app/pages/nuisance_tables.h"
#include "app/text/format.h"
#include "discovery/case/test_records.h"
#include "effects/effect.h"

namespace ambrig {
namespace {

/// The 95 % set of an adopted effect: the ranking's for the first, its own for a further one.
std::vector<SetMember> SetOf(const Explanation& e, std::size_t adopted) {
  if (adopted == 0) return e.set;
  const auto further = e.further_sets.find(Named(e.adopted[adopted]));
  return further == e.further_sets.end() ? std::vector<SetMember>{} : further->second;
}

}  // namespace

std::string AnswerText(const Explanation& e) {
  std::string text;
  for (std::size_t k = 0; k < e.adopted.size(); ++k) {
    const std::vector<SetMember> set = SetOf(e, k);
    std::string names;
    for (const SetMember& m : set)
      names += fmt::format(
          "{}{} ({:.0f} %)", names.empty() ? "" : " or ",
          m.target.empty() ? "no effect of the catalogue" : NameAtTarget(m.effect, m.target),
          100 * m.probability);
    text += (k > 0 ? " and " : "") + (set.size() > 1 ? names : EffectName(e.adopted[k]));
  }
  return text;
}

std::string DoubtText(const Explanation& e) {
  std::string text;
  for (std::size_t k = 0; k < e.adopted.size(); ++k) {
    const std::vector<SetMember> set = SetOf(e, k);
    const auto effects =
        std::count_if(set.begin(), set.end(), [](const SetMember& m) { return !m.target.empty(); });
    if (effects > 1) return "more than one effect remains";
    if (set.size() > 1) text = "no effect is certain";
  }
  return text;
}

std::string WhyNot(const Explanation& e, bool unseen) {
  if (e.ranking.empty() || !e.adopted.empty() || e.verdict == ExplanationVerdict::kEffect)
    return "";
  const FitResult& best = e.ranking.front().fit;
  const std::string name = EffectName(e.ranking.front().effect);
  if (e.ParametersNotBelieved())
    return name + " is not adopted: the rig's parameters explain the records as well.";
  if (e.verdict == ExplanationVerdict::kUnknown)
    return fmt::format(
        "{} is not adopted: with it {:.2f} times the noise is left{}, which the noise alone does "
        "not make. Its probability counts only the candidates listed.",
        name, best.ratio_fit,
        unseen ? fmt::format(" on the fitted and {:.2f} on the unseen records", best.ratio_validate)
               : "");
  return fmt::format(
      "{} is not adopted: without it the rig file{} explain the records to {:.3f} of the noise, "
      "with it to {:.3f}.",
      name,
      e.nuisances.empty()
          ? " and its tolerances"
          : ", its tolerances and what differs from record to record or coil to coil",
      e.final_ratio_validate, best.ratio_validate);
}

namespace {

std::string Evidence(const Explanation& e, bool unseen) {
  return fmt::format(
      "{}, the error falls from {:.2f} times the noise (rig "
      "file) to {:.2f} (rig parameters "
      "adjusted) to **{:.2f}** (final).{}",
      unseen ? "On records that were not used for fitting"
             : "All records were fitted, none was kept back to judge by; on them",
      e.nominal_ratio_validate, e.base_ratio_validate, e.final_ratio_validate,
      std::max(e.final_ratio_validate, e.final_ratio_fit) > 1.15
          ? " A residual remains, shown under *Residual*."
          : "");
}

std::vector<std::string> Faults(const Explanation& e) {
  std::vector<std::string> out;
  for (const DataFault& f : e.data) out.push_back(FaultText(f));
  return out;
}

/// The names that may be right, what is explained, and what is not.
void AddKnown(HtmlReport& report, const Explanation& e) {
  std::string set;
  for (const SetMember& m : e.set)
    set += fmt::format("{}**{}** ({:.0f} %)", set.empty() ? "" : ", ",
                       NameAtTarget(m.effect, m.target), 100 * m.probability);
  report.KeyValues({{"95 % set", set},
                    {"explained", fmt::format("{:.1f} % of the error above the noise, {:.2f} to "
                                              "{:.2f} times the noise over all records",
                                              100 * e.closure.explained, e.closure.floors_before,
                                              e.closure.floors_after)},
                    {"remainder", e.remainder.text}});
  if (!e.hidden.empty()) {
    std::vector<std::vector<Cell>> rows;
    for (const VisibleSize& v : e.hidden)
      if (std::isfinite(v.size) && rows.size() < 20)
        rows.push_back({NameAtTarget(v.effect, v.target), v.parameter, FormatSi(v.size, v.unit)});
    report.Table({"effect", "parameter", "could be this large"}, rows,
                 "What was not seen: sizes below these (three of their own sd) leave no trace in "
                 "these records.");
  }
  AddNuisances(report, e.nuisances);
}

void AddExplanationVerdict(HtmlReport& report, const Explanation& e, bool unseen) {
  report.Heading("Verdict");
  const std::string doubt = DoubtText(e);
  if (e.verdict == ExplanationVerdict::kEffect)
    report.Verdict(doubt.empty() ? Verdict::kOk : Verdict::kWarn,
                   fmt::format("**{}: {}.** {}",
                               doubt.empty() ? "Identified" : "An effect is missing, and " + doubt,
                               AnswerText(e), Evidence(e, unseen)));
  else if (e.verdict == ExplanationVerdict::kData)
    report.Verdict(
        Verdict::kWarn,
        "**The data are wrong.** Nothing was fitted to them. Apply the corrections listed "
        "below, then run explain again.");
  else if (e.verdict == ExplanationVerdict::kParameters)
    report.Verdict(Verdict::kInfo,
                   "**No effect is missing; the rig's parameters differ from the rig file** within "
                   "their tolerances. " +
                       Evidence(e, unseen));
  else if (e.verdict == ExplanationVerdict::kNone)
    report.Verdict(
        Verdict::kOk,
        "**Nothing is missing**: the rig file explains the measurements within their noise. " +
            Evidence(e, unseen));
  else if (e.ParametersNotBelieved())
    report.Verdict(
        Verdict::kWarn,
        "**Only rig parameters that are not believed explain the records**, beyond their "
        "tolerances or other ones from record to record (see the warnings). " +
            Evidence(e, unseen));
  else
    report.Verdict(Verdict::kWarn,
                   "**Something is missing, and no effect of the catalogue explains it.** " +
                       Evidence(e, unseen) + " Its description and a candidate law follow below.");
  if (!e.data.empty()) report.Text(List(Faults(e)));
  AddKnown(report, e);
}

void AddMeaning(HtmlReport& report, const Case& c, const Explanation& e) {
  for (const EffectInstance& a : e.adopted)
    if (const EffectDescription* d = FindEffect(a.name))
      report.Text(fmt::format("**{}** ({}). {} Found: {}.", d->title, EffectName(a),
                              OneLine(d->physics), ParametersText(a)));
  std::size_t unseen = 0;
  for (const CaseRecord& r : c.records) unseen += r.validate ? 1 : 0;
  report.KeyValues({{"records", unseen == 0 ? fmt::format("{}, all fitted", c.records.size())
                                            : fmt::format("{} fitted, {} unseen",
                                                          c.records.size() - unseen, unseen)},
                    {"candidates screened", fmt::format("{}", e.screened.size())},
                    {"record simulations", fmt::format("{}", e.runs)},
                    {"time", FormatSi(e.seconds, "s")}});
  AddReadingHelp(report, true);
  if (!c.notes.empty()) report.Text("Left out by the data-quality pass:\n\n" + List(c.notes));
}

/// Texts name data files with their folders; a reader wants the record.
std::string ShortPaths(std::string text, const Case& c) {
  for (const CaseRecord& r : c.records)
    for (std::size_t at; !r.data_file.empty() && r.data_file != ShortName(r.data_file) &&
                         (at = text.find(r.data_file)) != std::string::npos;)
      text.replace(at, r.data_file.size(), ShortName(r.data_file));
  return text;
}

void AddUnknown(HtmlReport& report, const Case& c, const Explanation& e) {
  if (e.verdict != ExplanationVerdict::kUnknown) return;
  const Unexplained& u = e.unexplained;
  report.Heading("Unexplained residual");
  report.Text(u.text.empty() ? "These records allow no further description."
                             : ShortPaths(u.text, c));
  std::vector<std::pair<std::string, std::string>> keys;
  for (const auto& [key, value] : {std::pair("block", u.block), {"where", u.where}})
    if (!value.empty()) keys.emplace_back(key, value);
  std::string peaks;
  for (const double f : u.frequencies) peaks += (peaks.empty() ? "" : ", ") + FormatSi(f, "Hz");
  if (!peaks.empty()) keys.emplace_back("stands out at", peaks);
  if (!keys.empty()) report.KeyValues(keys);
  if (u.formula.empty()) return;
  report.Text(
      "A law of this form fits the unmodelled force best. Paste it into the rig file, give its "
      "parameters rough starting values and bounds, and run `ambrig adopt CASE formula`: it is "
      "fitted like any effect, and the error should fall on the unseen records.");
  report.Code(FormulaSnippet(u));
}

void AddNext(HtmlReport& report, const Case& c, const Explanation& e) {
  report.Heading("Recommended next steps");
  std::vector<std::string> next;
  for (const Confusable& p : e.confusable)
    next.push_back(fmt::format(
        "These records do not discriminate between **{}** and **{}**. A record that does: {}.",
        p.first, p.second, p.record));
  if (e.verdict == ExplanationVerdict::kEffect) {
    if (e.confusable.empty())
      next.push_back("No other candidate is close; no further record is needed to discriminate.");
    for (const EffectInstance& a : e.adopted) {
      const EffectDescription* d = FindEffect(a.name);
      if (d && !d->shows_in.empty())
        next.push_back(
            fmt::format("To know the parameters of {} better, measure what shows it: {}.",
                        EffectName(a), d->shows_in));
      next.push_back(
          fmt::format("To add it to the rig: `ambrig adopt {} {} --target {}` writes a new rig "
                      "file and compares again.",
                      c.file, a.name, a.target));
    }
    if (e.RefineFollows())
      next.push_back(fmt::format(
          "The shape of its law leaves less than the catalogue's law: `ambrig refine {} "
          "{}@{}` fits it and writes a new rig file.",
          c.file, e.adopted[0].name, e.adopted[0].target));
  }
  if (e.verdict == ExplanationVerdict::kParameters)
    next.push_back("Correct the rig file: the table above says which numbers moved.");
  if (e.verdict == ExplanationVerdict::kNone)
    next.push_back(
        "Nothing needs to be added. To look for smaller effects, measure with more excitation or "
        "for longer.");
  if (e.verdict == ExplanationVerdict::kData)
    next.push_back("Put the lines above into the case file, or repeat the measurement.");
  if (e.verdict == ExplanationVerdict::kUnknown)
    next.push_back(
        "Try the law above, or measure a record that isolates the block named above: clamped for "
        "coil and force, slow roll for sensors.");
  report.Text(List(next));
}

void AddWarnings(HtmlReport& report, const Explanation& e) {
  std::vector<std::string> warnings = e.warnings;
  if (!e.final_fit.predicted.empty() && !e.final_fit.converged)
    warnings.push_back(
        "the last fit found no better point; its parameters are those it started from");
  if (warnings.empty()) return;
  report.Heading("Warnings");
  report.Verdict(Verdict::kWarn, "Warnings of the fits:");
  report.Text(List(warnings));
}

}  // namespace

void WriteExplainReport(const Case& c, const Explanation& e, const std::string& path) {
  const ExplainScene scene(c, e);
  HtmlReport report("Which effect is missing?", c.file);
  const bool unseen = AnyValidates(c);
  AddExplanationVerdict(report, e, unseen);
  AddMeaning(report, c, e);
  report.Heading("Error after each step");
  AddLadder(report, e.ladder);
  AddPlainFailure(report, scene);
  AddRanking(report, e, unseen);
  AddScreening(report, e, unseen);
  AddWhyThatOne(report, scene);
  AddCost(report, e);
  AddUnknown(report, c, e);
  AddWhatIsLeft(report, scene);
  AddNext(report, c, e);
  AddWarnings(report, e);
  report.Write(path);
}

}  // namespace ambrig
