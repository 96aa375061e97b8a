/// ambrig refine: the law's shape, once the effect is named.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/effect_names.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/refine_json.h"
#include "app/pages/refine_report.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/read_file.h"
#include "discovery/case/case_file.h"

namespace ambrig {

namespace {

struct RefineCommand {
  CommonOptions common;
  std::string file, effect, output, new_case;
};

void PrintRefinement(const Refinement& r, const std::string& output) {
  const char* unseen = r.any_unseen ? "unseen" : "all";
  fmt::print("{} at {}: {} against {}\n", r.effect, r.target, r.shape.value_name, r.shape.u_name);
  fmt::print("  {:>12} {:>12} {:>10} {:>8} {:>12}\n", fmt::format("u [{}]", r.shape.u_unit),
             fmt::format("law [{}]", r.shape.value_unit), "sd", "support", "catalogue");
  const std::size_t every = std::max<std::size_t>(1, (r.curve.size() - 1) / 12);
  for (std::size_t k = 0; k < r.curve.size(); k += every) {
    const CurvePoint& p = r.curve[k];
    fmt::print("  {:>12.4g} {:>12.4g} {:>10.2g} {:>8.2f} {:>12.4g}{}\n", p.u, p.value, p.sd,
               p.support, p.named, p.visited ? "" : "  not visited");
  }
  fmt::print("{}\n", TerminalText(SupportText(r)));
  fmt::print("error over noise (1: only noise is left):\n");
  for (const LadderStep& s : r.ladder)
    fmt::print("  {:<34} fit {:8.3f}   {} {:8.3f}\n", s.added, s.ratio_fit, unseen,
               s.ratio_validate);
  for (const std::string& w : r.warnings) fmt::print("{}\n", Wrapped("  warning: " + w, 4));
  fmt::print("compared again, {} records: {:.3f} (with the catalogue's law {:.3f})\nwritten {}\n",
             unseen, r.ratio_after, r.ratio_before, output);
}

int RunRefine(const RefineCommand& o) {
  const auto [name, target] = EffectAtTarget(o.effect);
  const Case c = ReadCase(o.file);
  const std::filesystem::path rig(c.rig_file);
  const std::string output =
      !o.output.empty() ? o.output
                        : (rig.parent_path() / (rig.stem().string() + "_refined.toml")).string();
  o.common.CheckOutputs({o.file, c.rig_file}, {output, o.new_case});
  ExplainOptions options;
  options.stop = &interrupted;
  Progress progress("refine");
  options.progress = [&](double f, const std::string& text) { progress.Update(f, text); };
  const Refinement r = Refine(c, name, target, output, options);
  WriteMarkedText(output, "refine", r.rig_text);
  if (!o.new_case.empty())
    WriteMarkedText(o.new_case, "refine",
                    CaseWithRig(ReadFile(o.file), o.file, output, o.new_case));
  progress.Clear();
  PrintRefinement(r, output);
  nlohmann::ordered_json json = RefineJson(r);
  json["rig"] = output;
  if (!o.new_case.empty()) json["case"] = o.new_case;
  o.common.WriteJson(json);
  if (!o.common.html.empty()) WriteRefineReport(r, output, o.common.html);
  return 0;
}

}  // namespace

void AddRefine(CLI::App& app, Work& work) {
  auto options = std::make_shared<RefineCommand>();
  CLI::App* command = app.add_subcommand(
      "refine", "fit the shape of a named effect's law and write it into a new rig file");
  command->add_option("case", options->file, "case file (TOML)")->required();
  command
      ->add_option("effect", options->effect,
                   "effect to refine, EFFECT or EFFECT@TARGET: " + RefinableEffects())
      ->required();
  command
      ->add_option("-o,--out,--output", options->output,
                   "new rig file (default: RIG_refined.toml beside the rig)")
      ->check(OutputFile());
  command
      ->add_option("--case", options->new_case,
                   "also write a case file with the same records and the new rig file")
      ->type_name("NEW_CASE")
      ->check(OutputFile());
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig refine practice/case.toml saturation@A --json law.json --html law.html\n"
      "  ambrig refine practice/case.toml saturation -o rig_2.toml\n"
      "The curve is a result where it is supported; outside it is a continuation.");
  command->callback([options, &work] { work = [options] { return RunRefine(*options); }; });
}

}  // namespace ambrig
