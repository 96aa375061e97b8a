/// ambrig adopt: add an effect with fitted parameters, compare again.
#include <fmt/format.h>

#include <filesystem>
#include <tuple>

#include "app/commands/commands.h"
#include "app/commands/effect_names.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/discovery_json.h"
#include "app/pages/discovery_report.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/read_file.h"
#include "discovery/case/case_file.h"
#include "discovery/refine/adopt.h"

namespace ambrig {

namespace {

struct AdoptCommand {
  CommonOptions common;
  std::string file, effect, target, output, new_case;
};

void PrintAdoption(const Adoption& a, const std::string& output) {
  const EffectInstance& e = a.effects.back();
  fmt::print("{} at {}\n", e.name, e.target);
  for (std::size_t k = 0; k < e.table.size(); ++k)
    fmt::print("  {:<16} {:.6g}{}{}\n", e.table[k].name, e.values[k],
               e.sd[k] > 0 ? fmt::format(" +- {:.2g}", e.sd[k]) : "",
               e.table[k].unit == "-" ? std::string() : fmt::format(" {}", e.table[k].unit));
  const bool unseen = a.before.ratio_validate > 0;
  // the comparison shows a record as it is; the fits take off what may differ from record to record
  const bool differ = a.adopted_case->nuisances.any();
  fmt::print("error over noise (1: only noise is left){}:\n",
             differ ? ", less what [nuisance] allows each record" : "");
  for (const LadderStep& s : a.ladder)
    fmt::print("  {:<34} fit {:8.3f}   unseen {:>8}\n", s.added.empty() ? "rig file" : s.added,
               s.ratio_fit, unseen ? fmt::format("{:.3f}", s.ratio_validate) : "-");
  if (!unseen) fmt::print("  no record of the case has use = \"validate\": all were fitted\n");
  for (const std::string& s : a.parameter_shifts)
    fmt::print("{}\n", Wrapped("  parameter " + s +
                                   " from the rig file: measure it, or look for what "
                                   "it stands in for (ambrig explain)",
                               4));
  for (const std::string& s : a.before.left_out) fmt::print("{}\n", Wrapped("  " + s, 4));
  for (const std::string& w : a.fit.warnings) fmt::print("  warning: {}\n", w);
  if (!a.fit.converged) fmt::print("  warning: the fit did not converge\n");
  fmt::print("compared again, all records{}: {:.3f} (was {:.3f})\nwritten {}\n",
             differ ? " with that" : "", a.after.ratio, a.before.ratio, output);
}

nlohmann::ordered_json AdoptionJson(const Adoption& a, const std::string& output,
                                    const std::string& new_case) {
  nlohmann::ordered_json json = CompareJson(a.after);
  json["before"] = CompareJson(a.before);
  json["rig"] = output;
  if (!new_case.empty()) json["case"] = new_case;
  json["converged"] = a.fit.converged;
  json["parameter_shifts"] = a.parameter_shifts;
  json["warnings"] = a.fit.warnings;
  for (const LadderStep& s : a.ladder)
    json["ladder"].push_back(
        {{"added", s.added}, {"ratio_fit", s.ratio_fit}, {"ratio_validate", s.ratio_validate}});
  return json;
}

int RunAdopt(AdoptCommand o) {
  if (o.effect.find('@') != std::string::npos) {
    if (!o.target.empty())
      throw InputError(
          fmt::format("--target = {}: {} names one, allowed: either", o.target, o.effect));
    std::tie(o.effect, o.target) = EffectAtTarget(o.effect);
  }
  const Case c = ReadCase(o.file);
  const std::filesystem::path rig(c.rig_file);
  const std::string output =
      !o.output.empty() ? o.output
                        : (rig.parent_path() / (rig.stem().string() + "_adopted.toml")).string();
  o.common.CheckOutputs({o.file, c.rig_file}, {output, o.new_case});
  Progress progress("adopt");
  ExplainOptions options;
  options.stop = &interrupted;
  options.progress = [&](double f, const std::string& text) { progress.Update(f, text); };
  const Adoption a = Adopt(c, o.effect, o.target, output, options);
  WriteMarkedText(output, "adopt", a.rig_text);
  if (!o.new_case.empty())
    WriteMarkedText(o.new_case, "adopt", CaseWithRig(ReadFile(o.file), o.file, output, o.new_case));
  progress.Clear();
  PrintAdoption(a, output);
  o.common.WriteJson(AdoptionJson(a, output, o.new_case));
  if (!o.common.html.empty())
    WriteAdoptReport(*a.model, a.before, a.after, a.ladder, o.common.html);
  return 0;
}

}  // namespace

void AddAdopt(CLI::App& app, Work& work) {
  auto options = std::make_shared<AdoptCommand>();
  CLI::App* command = app.add_subcommand(
      "adopt", "add an effect with fitted parameters to the rig file and compare again");
  command->add_option("case", options->file, "case file (TOML)")->required();
  command->add_option("effect", options->effect, "EFFECT or EFFECT@TARGET (ambrig effects)")
      ->required();
  command->add_option("--target", options->target,
                      "target of the effect (default: the one with the best fit)");
  command
      ->add_option("-o,--out,--output", options->output,
                   "new rig file (default: RIG_adopted.toml beside the rig)")
      ->check(OutputFile());
  command
      ->add_option("--case", options->new_case,
                   "also write a case file with the same records and the new rig file")
      ->type_name("NEW_CASE")
      ->check(OutputFile());
  options->common.AddTo(*command);
  command->footer(
      "Examples (after ambrig hide, see its --help):\n"
      "  ambrig adopt practice/case.toml sensor-gain\n"
      "  ambrig adopt practice/case.toml eddy-currents --target A -o with_eddy.toml \\\n"
      "      --case case_2.toml\n"
      "The second can be compared and explained again: ambrig explain case_2.toml");
  command->callback([options, &work] { work = [options] { return RunAdopt(*options); }; });
}

}  // namespace ambrig
