/// ambrig plan: the next record, which tells apart the names that are left.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "app/commands/commands.h"
#include "app/commands/effect_names.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/plan_json.h"
#include "app/pages/plan_report.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/read_file.h"
#include "core/base/toml.h"
#include "core/base/toml_edit.h"
#include "core/math/constants.h"
#include "discovery/case/case_file.h"
#include "discovery/explain/explain.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct PlanCommand {
  CommonOptions common;
  std::string file, output;
  std::vector<std::string> learn, between;
  double speed = 0;  // [Hz]
  bool clamp = false;
  int draws = 30;
  std::int64_t seed = 1;
};

EffectNames EffectNamesOf(const std::vector<std::string>& texts, const std::string& option) {
  const EffectNames out = EffectsAtTargets(texts, option);
  for (const auto& [name, target] : out)
    if (name != "nothing") EffectNamed(name);
  return out;
}

/// The scenario beside the rig that it names.
std::string ScenarioText(const Plan& plan, const std::string& rig, const std::string& output) {
  const std::string folder = std::filesystem::path(output).parent_path().string(),
                    path = NameFrom(folder, rig);
  return EditedToml(plan.toml, output, {{"rig", TomlLiteral{fmt::format("\"{}\"", path)}}});
}

void PrintPlan(const Plan& plan, const std::string& output) {
  fmt::print("{:<34} {:>6} {:>14} {:>14}\n", "scenario", "size", "distance [sd]", "orbit [um]");
  for (std::size_t k = 0; k < plan.tried.size() && k < 10; ++k) {
    const TriedScenario& t = plan.tried[k];
    fmt::print(
        "{:<34} {:>6.2g} {:>14} {:>14}\n", t.title, t.size,
        t.refused.empty() ? fmt::format("{:.1f}", t.least_distance) : "-",
        t.largest_orbit > 0 ? fmt::format("{:.1f} {}", 1e6 * t.largest_orbit, t.orbit_at) : "-");
    if (!t.refused.empty()) fmt::print("{}\n", Wrapped("    not safe: " + t.refused, 4));
  }
  fmt::print(
      "size: share of the usual excitation, lowered until every model stays up;\n"
      "distance: the least between two of the names (4.7: right in 99 %)\n\n");
  std::istringstream lines(plan.text);
  for (std::string line; std::getline(lines, line);) fmt::print("{}\n", Wrapped(line, 2));
  for (const std::string& w : plan.warnings) fmt::print("{}\n", Wrapped("warning: " + w, 2));
  fmt::print("written {}; {} record simulations\n", output, plan.runs);
}

Plan PlanOfCase(const PlanCommand& o, const Case& c, const PlanOptions& options) {
  if (!o.between.empty()) return PlanForCase(c, EffectNamesOf(o.between, "--between"), options);
  ExplainOptions explain;
  explain.stop = &interrupted;
  explain.progress = [&](double f, const std::string& text) {
    if (options.progress) options.progress(0.5 * f, "explain: " + text);
  };
  const Explanation e = Explain(c, explain);
  if (e.verdict == ExplanationVerdict::kData)
    throw InputError(o.file + ": the data are wrong, as `ambrig explain` says; correct them first");
  return PlanForCase(c, NamesLeft(e), options);
}

int RunPlanCommand(const PlanCommand& o) {
  const std::string text = ReadFile(o.file);
  const bool is_case = TomlTable::FromText(text, o.file).Has("record");
  if (is_case && !o.learn.empty())
    throw InputError("--learn: needs a rig file, allowed with a case: --between");
  if (!is_case && o.learn.empty())
    throw InputError(o.file +
                     ": is no case (it has no [[record]]); with a rig file --learn EFFECT "
                     "is needed");
  if (!is_case && !o.between.empty())
    throw InputError("--between: needs a case, allowed with a rig file: --learn");
  if (o.between.size() == 1)
    throw InputError("--between: one name, allowed: two or more to tell apart, e.g. nothing " +
                     o.between[0]);
  const std::filesystem::path path(o.file);
  const std::string output =
      !o.output.empty() ? o.output : (path.parent_path() / "next_record.toml").string();
  o.common.CheckOutputs({o.file}, {output});
  Progress progress("plan");
  PlanOptions options;
  options.draws = o.draws;
  options.seed = static_cast<std::uint64_t>(o.seed);
  options.stop = &interrupted;
  options.progress = [&](double f, const std::string& t) { progress.Update(f, t); };
  Plan plan;
  std::string rig_file = o.file;
  if (is_case) {
    const Case c = ReadCase(o.file);
    rig_file = c.rig_file;
    plan = PlanOfCase(o, c, options);
  } else {
    const RigParameters rig = ReadRig(o.file);
    plan = PlanForRig(rig, EffectNamesOf(o.learn, "--learn"),
                      StatedAbilities(rig, 2 * kPi * o.speed, o.clamp), options);
  }
  const std::string scenario = "# made by ambrig plan\n" + ScenarioText(plan, rig_file, output);
  WriteMarkedText(output, "plan", scenario);
  progress.Clear();
  PrintPlan(plan, output);
  o.common.WriteJson(PlanJson(plan, output));
  plan.toml = scenario;
  if (!o.common.html.empty()) WritePlanReport(plan, o.file, output, o.common.html);
  return 0;
}

}  // namespace

void AddPlan(CLI::App& app, Work& work) {
  auto options = std::make_shared<PlanCommand>();
  CLI::App* command = app.add_subcommand(
      "plan", "find the record to make next: what tells the remaining effects apart, safely");
  command->add_option("file", options->file, "case file, or rig file with --learn (TOML)")
      ->required();
  command
      ->add_option("--learn", options->learn,
                   "with a rig file: EFFECT[@TARGET] that the record should show")
      ->type_name("EFFECT");
  command
      ->add_option("--between", options->between,
                   "with a case: EFFECT[@TARGET] or \"nothing\" to tell apart (default: what "
                   "explain leaves open)")
      ->type_name("EFFECT");
  command
      ->add_option(
          "--speed", options->speed,
          "with a rig file: highest speed that the rig may turn at [Hz], or with its unit: "
          "3000rpm (default: it does not turn)")
      ->transform(SpeedUnit("Hz"))
      ->check(NumberIn(0, 1e5, "Hz"));
  command->add_flag("--clamp", options->clamp,
                    "with a rig file: the rotor can be held, with load cells");
  command
      ->add_option("--draws", options->draws, "simulated records per pair that check the promise")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command->add_option("--seed", options->seed, "of phases and simulated records")
      ->capture_default_str()
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 40));
  command
      ->add_option("-o,--out,--output", options->output,
                   "scenario file (default: next_record.toml beside the file)")
      ->check(OutputFile());
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig plan examples/reference/rig.toml --learn side-pull@A cross-coupling@A\n"
      "  ambrig plan practice/case.toml --json plan.json --html plan.html");
  command->callback([options, &work] { work = [options] { return RunPlanCommand(*options); }; });
}

}  // namespace ambrig
