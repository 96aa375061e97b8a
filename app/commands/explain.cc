/// ambrig explain: which physical effect is missing.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/event_stream.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/commands/work_size.h"
#include "app/json/discovery_json.h"
#include "app/pages/discovery_report.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "discovery/case/test_records.h"
#include "discovery/decision/second_round.h"
#include "discovery/explain/explain.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

struct ExplainCommand {
  CommonOptions common;
  std::string file, resume, law;
  int candidates = 5;
  bool verbose = false, long_runs = false;
};

/// What a reader has to know of a value without sd, beside others that have one.
std::string RemarkOfValue(const EffectInstance& e, std::size_t k) {
  const auto known = [](double sd) { return sd > 0; };
  if (k >= e.sd.size() || known(e.sd[k]) || std::none_of(e.sd.begin(), e.sd.end(), known))
    return "";
  const EffectParameter& p = e.table[k];
  return e.values[k] == p.lo || e.values[k] == p.hi ? " (at its limit)" : " (not determined)";
}

std::string ShortParametersText(const EffectInstance& e) {
  std::string text;
  for (std::size_t k = 0; k < e.table.size(); ++k)
    text += fmt::format("{}{} = {:.4g}{}{}{}", k == 0 ? "" : ", ", e.table[k].name, e.values[k],
                        k < e.sd.size() && e.sd[k] > 0 ? fmt::format(" +- {:.2g}", e.sd[k]) : "",
                        e.table[k].unit == "-" ? "" : " " + e.table[k].unit, RemarkOfValue(e, k));
  return text;
}

void PrintWrapped(const std::string& text, std::size_t indent = 4) {
  fmt::print("{}\n", Wrapped(text, indent));
}

/// `unseen`: some records were kept back from the fits.
void PrintRanking(const std::vector<RankedEffect>& ranking, std::size_t most, bool unseen) {
  fmt::print("{:>4} {:<32} {:<14} {:>6} {:>8} {:>8}\n", "", "effect", "target", "prob.", "fitted",
             unseen ? "unseen" : "all");
  for (std::size_t k = 0; k < std::min(most, ranking.size()); ++k) {
    const RankedEffect& r = ranking[k];
    fmt::print("{:>4} {:<32} {:<14} {:>6.3f} {:>8.3f} {:>8.3f}\n", k + 1,
               Shortened(r.effect.name, 32), Shortened(r.effect.target, 14), r.probability,
               r.fit.ratio_fit, r.fit.ratio_validate);
    if (const std::string text = ShortParametersText(r.effect); !text.empty())
      PrintWrapped("       " + text, 7);
    if (r.shaped)
      fmt::print("{:<58}{:>8.3f} {:>8.3f}\n", "       with the shape of its law free",
                 r.shaped->fit, r.shaped->validate);
  }
}

std::string SetText(const std::vector<SetMember>& set) {
  std::string text;
  for (const SetMember& m : set)
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", NameAtTarget(m.effect, m.target),
                        100 * m.probability);
  return text;
}

std::string NamesInLine(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// What differs from record to record, a line for each; errors of coils in a line for each kind.
void PrintNuisances(const std::vector<NuisanceFound>& nuisances) {
  constexpr double kSeen = 3;  // sd
  std::map<NuisanceGroup, std::string> of_coils;
  for (const NuisanceFound& n : nuisances) {
    if (std::abs(n.value) < kSeen * n.sd) continue;
    const std::string unit = n.unit == "-" ? "" : " " + n.unit;
    if (!n.coil.empty()) {
      std::string& line = of_coils[n.group];
      line += fmt::format("{}{} {:.2g}{}", line.empty() ? "" : ", ", n.coil, n.value, unit);
    } else {
      PrintWrapped(
          fmt::format("  {} in {}: {:.3g} +- {:.2g}{}", n.name, n.record, n.value, n.sd, unit));
    }
  }
  for (const auto& [group, line] : of_coils)
    PrintWrapped(fmt::format("  {} of single coils: {}", ToText(group), line));
}

void PrintFindings(const Explanation& e) {
  for (const DataFault& f : e.data) PrintWrapped("  data: " + FaultText(f));
  if (e.verdict == ExplanationVerdict::kEffect)
    fmt::print("  explained: {:.1f} % of the error above the noise, {:.2f} -> {:.2f}\n",
               100 * e.closure.explained, e.closure.floors_before, e.closure.floors_after);
  PrintWrapped("  95 % set: " + SetText(e.set) +
               (e.judged_beside.empty() ? "" : " (beside " + NamesInLine(e.judged_beside) + ")"));
  for (const auto& [name, set] : e.further_sets)
    PrintWrapped("  95 % set of " + name + ": " + SetText(set));
  for (const EffectInstance& a : e.adopted)
    PrintWrapped(fmt::format("  adopted {} at {}: {}", a.name, a.target, ShortParametersText(a)));
  for (const std::string& s : e.parameter_shifts) PrintWrapped("  parameter " + s);
  PrintNuisances(e.nuisances);
  for (std::size_t k = 0; k < e.hidden.size() && k < 6; ++k)
    PrintWrapped(fmt::format("  not seen: {} at {} up to {} = {:.3g} {}", e.hidden[k].effect,
                             e.hidden[k].target, e.hidden[k].parameter, e.hidden[k].size,
                             e.hidden[k].unit));
  for (const Confusable& c : e.confusable)
    PrintWrapped(fmt::format("  {} or {}: a record that discriminates between them: {}", c.first,
                             c.second, c.record));
  for (const std::string& w : e.warnings) PrintWrapped("  warning: " + w);
}

/// The commands that tell the names apart, where there are several, and that write the first into a
/// rig file.
void PrintNextCommand(const Explanation& e, const std::string& file) {
  if (e.verdict != ExplanationVerdict::kEffect || e.adopted.empty()) return;
  std::string names;
  int count = 0;
  for (const SetMember& m : e.set)
    if (!m.target.empty() && ++count <= 2) names += fmt::format(" {}@{}", m.effect, m.target);
  if (count > 1) fmt::print("to tell them apart: ambrig plan {} --between{}\n", file, names);
  fmt::print("to add it to the rig file: ambrig adopt {} {} --target {}\n", file, e.adopted[0].name,
             e.adopted[0].target);
  if (e.RefineFollows())
    fmt::print("to fit the shape of its law: ambrig refine {} {}@{}\n", file, e.adopted[0].name,
               e.adopted[0].target);
}

void PrintExplanation(const Explanation& e, bool unseen) {
  fmt::print(
      "error over noise, {} records: rig file {:.3f}, parameters fitted {:.3f},\n"
      "final {:.3f} (1: only noise is left)\n",
      unseen ? "unseen" : "all", e.nominal_ratio_validate, e.base_ratio_validate,
      e.final_ratio_validate);
  if (!unseen) fmt::print("no record of the case has use = \"validate\": all were fitted\n");
  if (!e.ranking.empty()) PrintRanking(e.ranking, e.ranking.size(), unseen);
  if (!e.second_round.empty()) {
    PrintWrapped(SecondRoundTitle(e), 2);
    PrintRanking(e.second_round, 3, unseen);
  }
  fmt::print("verdict: {}\n",
             Coloured(ToText(e.verdict), e.verdict == ExplanationVerdict::kUnknown ||
                                                 e.verdict == ExplanationVerdict::kData ||
                                                 !DoubtText(e).empty()
                                             ? "yellow"
                                             : "green"));
  if (const std::string doubt = DoubtText(e);
      e.verdict == ExplanationVerdict::kEffect && !doubt.empty())
    PrintWrapped("  " + doubt + ": " + AnswerText(e), 4);
  PrintWrapped("  " + e.remainder.text, 2);
  if (const std::string why = WhyNot(e, unseen); !why.empty()) PrintWrapped("  " + why, 2);
  PrintFindings(e);
  if (e.verdict == ExplanationVerdict::kUnknown) {
    PrintWrapped("  " + e.unexplained.text, 2);
    if (!e.unexplained.formula.empty()) {
      fmt::print("  a candidate law for the rig file ([[effect]] name = \"formula\"):\n");
      fmt::print("    {}\n", e.unexplained.formula);
    }
  }
  fmt::print("{} in {:.1f} s\n", Counted(e.runs, "record simulation"), e.seconds);
}

void PrintTest(const Case& c, const Explanation& e) {
  if (std::ranges::none_of(c.records, &CaseRecord::test) || std::isnan(e.closure.test_after))
    return;
  fmt::print("records of the test, which nothing was chosen by: {:.3f} -> {:.3f}\n",
             e.closure.test_before, e.closure.test_after);
}

/// The part of the work that a progress text belongs to, for --events.
std::string_view StageOf(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kStages[] = {
      {"noise floor", "noise"},
      {"are the data", "data"},
      {"rig parameters", "parameters"},
      {"what may", "parameters"},
      {"screening", "screening"}};
  for (const auto& [begin, stage] : kStages)
    if (text.starts_with(begin)) return stage;
  return text.find("fit") != std::string_view::npos ? "fits" : "remainder";
}

int RunExplain(const ExplainCommand& o) {
  const Case c = ReadCase(o.file);
  o.common.CheckOutputs({o.file, c.rig_file}, {o.law});
  for (const std::string& note : c.notes) PrintWrapped("data: " + note, 6);
  CheckWorkSize(o.file, ExplainSize(c), o.long_runs);
  std::unique_ptr<RunStore> store;
  if (!o.resume.empty()) store = std::make_unique<RunStore>(o.resume, c);
  if (store && store->size() > 0)
    fmt::print("{} of an interrupted call found in {}\n", Counted(store->size(), "simulation"),
               store->path());
  Explanation e;
  {
    Progress progress("explain");
    ExplainOptions options;
    options.candidates = o.candidates;
    options.stop = &interrupted;
    options.store = store.get();
    const auto begin = std::chrono::steady_clock::now();
    options.tell_runs = o.verbose;
    options.progress = [&](double f, const std::string& text) {
      Events().Stage(StageOf(text));
      progress.Update(f, text);
      if (o.verbose)
        fmt::print(stderr, "{:7.1f} s  {:3.0f} %  {}\n",
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                   100 * f, text);
    };
    if (!o.common.json.empty() || Events().open())
      options.checkpoint = [&](const Explanation& partial) {
        const nlohmann::ordered_json j = ExplainJson(partial);
        o.common.WriteJson(j);
        Events().Partial(j);
      };
    e = Explain(c, options);
  }
  PrintExplanation(e, AnyValidates(c));
  PrintTest(c, e);
  PrintNextCommand(e, o.file);
  o.common.WriteJson(ExplainJson(e));
  if (!o.common.html.empty()) WriteExplainReport(c, e, o.common.html);
  if (!o.law.empty() && e.unexplained.formula.empty())
    fmt::print("no candidate law: {} is not written\n", o.law);
  if (!o.law.empty() && !e.unexplained.formula.empty())
    WriteMarkedText(o.law, "explain", e.unexplained.formula + "\n");
  if (store) std::filesystem::remove(store->path());  // answered: nothing to go on with
  return 0;
}

}  // namespace

void AddExplain(CLI::App& app, Work& work) {
  auto options = std::make_shared<ExplainCommand>();
  CLI::App* command = app.add_subcommand(
      "explain", "find which physical effect the model lacks: ranked candidates with evidence");
  command->add_option("case", options->file, "case file (TOML)")->required();
  command->add_option("--candidates", options->candidates, "effects fitted in full per round")
      ->capture_default_str()
      ->check(CLI::Range(1, 60));
  command->add_flag("--long", options->long_runs, "start also when the estimate exceeds a day");
  command->add_flag("--verbose", options->verbose, "print every step with its time to stderr");
  command
      ->add_option("--law", options->law,
                   "with the verdict unknown: write the candidate law to this file, an [[effect]] "
                   "to append to the rig file")
      ->check(OutputFile())
      ->type_name("FILE");
  command
      ->add_option("--resume", options->resume,
                   "keep the simulations in this folder (some 100 MB) until the answer is written; "
                   "re-run the command to resume")
      ->type_name("FOLDER");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig explain examples/rub/case.toml --json answer.json --html answer.html\n"
      "  ambrig explain examples/rub/case.toml --law law.toml --resume work\n"
      "Re-run the second command after Ctrl-C to resume; law.toml is a\n"
      "candidate law to append to the rig file. Intermediate results are written to\n"
      "the JSON file as they come (verdict \"unfinished\").");
  command->callback([options, &work] { work = [options] { return RunExplain(*options); }; });
}

}  // namespace ambrig
