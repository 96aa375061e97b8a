/// ambrig explain: which physical effect is missing.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/discovery_json.h"
#include "app/pages/discovery_report.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

struct ExplainCommand {
  CommonOptions common;
  std::string file, resume, law;
  int candidates = 5;
  bool verbose = false;
};

std::string ParametersText(const EffectInstance& e) {
  std::string text;
  for (std::size_t k = 0; k < e.table.size(); ++k)
    text += fmt::format("{}{} = {:.4g}{}{}", k == 0 ? "" : ", ", e.table[k].name, e.values[k],
                        k < e.sd.size() && e.sd[k] > 0 ? fmt::format(" +- {:.2g}", e.sd[k]) : "",
                        e.table[k].unit == "-" ? "" : " " + e.table[k].unit);
  return text;
}

void Print(const Explanation& e) {
  fmt::print(
      "error over the noise floor on unseen records: rig file {:.3f}, parameters fitted {:.3f}, "
      "final {:.3f}\n",
      e.nominal_ratio_validate, e.base_ratio_validate, e.final_ratio_validate);
  fmt::print("{:>4} {:<24} {:<10} {:>6} {:>9} {:>9}  parameters\n", "", "effect", "target", "prob.",
             "fit", "unseen");
  for (std::size_t k = 0; k < e.ranking.size(); ++k) {
    const RankedEffect& r = e.ranking[k];
    fmt::print("{:>4} {:<24} {:<10} {:>6.3f} {:>9.3f} {:>9.3f}  {}\n", k + 1, r.effect.name,
               r.effect.target, r.probability, r.fit.ratio_fit, r.fit.ratio_validate,
               ParametersText(r.effect));
  }
  if (!e.second_round.empty()) {
    fmt::print("after adopting the first:\n");
    for (std::size_t k = 0; k < e.second_round.size() && k < 3; ++k) {
      const RankedEffect& r = e.second_round[k];
      fmt::print("{:>4} {:<24} {:<10} {:>6.3f} {:>9.3f} {:>9.3f}  {}\n", k + 1, r.effect.name,
                 r.effect.target, r.probability, r.fit.ratio_fit, r.fit.ratio_validate,
                 ParametersText(r.effect));
    }
  }
  fmt::print(
      "verdict: {}; {}\n",
      Coloured(e.verdict, e.verdict == "unknown" || e.verdict == "data" ? "yellow" : "green"),
      e.remainder.text);
  for (const DataFault& f : e.data) fmt::print("  data: {}\n", FaultText(f));
  if (e.verdict == "effect")
    fmt::print("  explained: {:.1f} % of the error above the noise, {:.2f} -> {:.2f} floors\n",
               100 * e.closure.explained, e.closure.floors_before, e.closure.floors_after);
  std::string set;
  for (const SetMember& m : e.set)
    set += fmt::format("{}{}{} {:.0f} %", set.empty() ? "" : ", ", m.effect,
                       m.target.empty() ? "" : " at " + m.target, 100 * m.probability);
  fmt::print("  95 % set: {}\n", set);
  for (const EffectInstance& a : e.adopted)
    fmt::print("  adopted {} at {}: {}\n", a.name, a.target, ParametersText(a));
  for (const std::string& s : e.parameter_shifts) fmt::print("  parameter {}\n", s);
  for (const NuisanceFound& n : e.nuisances)
    if (std::abs(n.value) > 3 * n.sd)
      fmt::print("  {} in {}: {:.3g} +- {:.2g} {}\n", n.name, n.record, n.value, n.sd, n.unit);
  for (std::size_t k = 0; k < e.hidden.size() && k < 6; ++k)
    fmt::print("  not seen: {} at {} up to {} = {:.3g} {}\n", e.hidden[k].effect,
               e.hidden[k].target, e.hidden[k].parameter, e.hidden[k].size, e.hidden[k].unit);
  for (const Confusable& c : e.confusable)
    fmt::print("  {} or {}: a record that discriminates between them: {}\n", c.first, c.second,
               c.record);
  for (const std::string& w : e.warnings) fmt::print("  warning: {}\n", w);
  if (e.verdict == "unknown") {
    fmt::print("  {}\n", e.unexplained.text);
    if (!e.unexplained.formula.empty())
      fmt::print("  a candidate law for the rig file ([[effect]] name = \"formula\"): {}\n",
                 e.unexplained.formula);
  }
  fmt::print("{} in {:.1f} s\n", Counted(e.runs, "record simulation"), e.seconds);
}

int RunExplain(const ExplainCommand& o) {
  const Case c = ReadCase(o.file);
  o.common.CheckOutputs({o.file, c.rig_file}, {o.law});
  for (const std::string& note : c.notes) fmt::print("data: {}\n", note);
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
    options.progress = [&](double f, const std::string& text) {
      progress.Update(f, text);
      if (o.verbose)
        fmt::print(stderr, "{:7.1f} s  {:3.0f} %  {}\n",
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                   100 * f, text);
    };
    if (!o.common.json.empty())
      options.checkpoint = [&](const Explanation& partial) {
        nlohmann::ordered_json j = ExplainJson(partial);
        j["verdict"] = "unfinished";
        o.common.WriteJson(j);
      };
    e = Explain(c, options);
  }
  Print(e);
  o.common.WriteJson(ExplainJson(e));
  if (!o.common.html.empty()) WriteExplainReport(c, e, o.common.html);
  if (!o.law.empty() && e.unexplained.formula.empty())
    fmt::print("no candidate law: {} is not written\n", o.law);
  if (!o.law.empty() && !e.unexplained.formula.empty())
    WriteFileAtomically(o.law, e.unexplained.formula + "\n");
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
      "Examples:\n  ambrig explain case.toml --json answer.json --html answer.html\n  ambrig "
      "explain case.toml --law law.toml; cat rig.toml law.toml > rig_2.toml\n  ambrig explain "
      "case.toml --resume work       # after Ctrl-C: resumes\nIntermediate results are written to "
      "the JSON file as they come (verdict \"unfinished\").");
  command->callback([options, &work] { work = [options] { return RunExplain(*options); }; });
}

}  // namespace ambrig
