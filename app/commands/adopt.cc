/// ambrig adopt: add an effect with fitted parameters, compare again.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/report/discovery_json.h"
#include "app/report/discovery_report.h"
#include "app/report/progress.h"
#include "core/base/atomic_file.h"
#include "core/base/read_file.h"
#include "discovery/adopt.h"
#include "discovery/candidate_fit.h"
#include "discovery/screen.h"
#include "scenarios/rig.h"

namespace ambrig {

namespace {

struct AdoptCommand {
  CommonOptions common;
  std::string file, effect, target, output;
};

void CheckTarget(const EffectDescription& d, const Case& c, const std::string& wanted) {
  std::string names;
  for (const auto& t : TargetsOf(d, TargetsOfEffects(c.rig))) {
    if (t == wanted || wanted.empty()) return;
    names += (names.empty() ? "" : ", ") + t;
  }
  throw InputError(fmt::format("--target = {}, allowed with {}: {}", wanted, d.id, names.empty() ? "no target of this rig" : names));
}

/// The effect at the named target, or where it explains most.
FitResult FitEffect(const CaseModel& model, const FitResult& base, const ScreenOptions& what) {
  SignatureBank bank;
  const std::vector<Candidate> candidates = Screen(model, base, FindPeaks(model, base.residual), what, bank);
  FitResult best;
  best.ratio_fit = kInfinity;
  for (std::size_t k = 0; k < std::min<std::size_t>(candidates.size(), 3); ++k) {
    FitResult fit = FitBriefly(model, base, candidates[k], what.effective);
    if (fit.converged && fit.ratio_fit < best.ratio_fit) best = std::move(fit);
  }
  return best;
}

int RunAdopt(const AdoptCommand& o) {
  const Case c = ReadCase(o.file);
  const EffectDescription* d = FindEffect(o.effect);
  if (!d) {
    std::string all;
    for (const auto& k : Catalogue()) all += (all.empty() ? "" : ", ") + k.id;
    const std::string near = Nearest(o.effect, all);
    throw InputError(fmt::format("{} is no effect{}, allowed: {}", o.effect, near.empty() ? "" : ", did you mean " + near + "?", all));
  }
  Progress progress("adopt");
  CaseModel model(c);
  model.stop = &interrupted;
  const Hypothesis nominal = Hypothesis::Base(c.rig);
  const Comparison before = Compare(model, nominal, false);
  FitOptions options;
  options.effective = before.effective;
  progress.Update(0.2, "rig parameters");
  FitResult base = Fit(model, nominal, options);
  std::vector<LadderStep> ladder = {{"", before.ratio_fit, before.ratio_validate}, {"parameters", base.ratio_fit, base.ratio_validate}};
  FitResult fit;
  std::vector<EffectInstance> added;
  if (o.effect == "formula") {
    // The formula stands in the rig file already and was fitted with the rig parameters.
    fit = base;
    bool any = false;
    for (std::size_t k = 0; k < fit.hypothesis.rig.effects.size(); ++k) any = any || fit.hypothesis.rig.effects[k].name == "formula";
    if (!any) throw InputError(fmt::format("{}: has no [[effect]] name = \"formula\" to fit; write one first", c.rig_file));
  } else {
    CheckTarget(*d, c, o.target);
    ScreenOptions what;
    what.effective = before.effective;
    what.effect = o.effect;
    what.target = o.target;
    what.progress = [&](double f, const std::string& text) { progress.Update(0.3 + 0.3 * f, text); };
    fit = FitEffect(model, base, what);
    if (!fit.converged) throw InputError(fmt::format("{}: no fit of {} holds the rotor", o.file, o.effect));
    progress.Update(0.8, "final fit");
    fit = Fit(model, fit.hypothesis, options);
    EffectInstance e = fit.hypothesis.rig.effects.back();
    for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k)
      if (fit.hypothesis.free[k].effect + 1 == static_cast<int>(fit.hypothesis.rig.effects.size())) e.sd[fit.hypothesis.free[k].row] = fit.sd[k];
    added.push_back(e);
    ladder.push_back({e.name + " at " + e.target, fit.ratio_fit, fit.ratio_validate});
  }
  std::string rig_text = ReadFile(c.rig_file);
  if (o.effect == "formula") {  // its fitted values replace the user's starting ones
    rig_text = rig_text.substr(0, rig_text.find("[[effect]]"));
    for (const EffectInstance& e : c.rig.effects)
      if (e.name != "formula") added.push_back(e);
    for (std::size_t k = 0; k < fit.hypothesis.rig.effects.size(); ++k) {
      EffectInstance e = fit.hypothesis.rig.effects[k];
      if (e.name != "formula") continue;
      for (std::size_t p = 0; p < fit.hypothesis.free.size(); ++p)
        if (fit.hypothesis.free[p].effect == static_cast<int>(k)) e.sd[fit.hypothesis.free[p].row] = fit.sd[p];
      added.push_back(e);
    }
  }
  const std::string output = !o.output.empty() ? o.output : (std::filesystem::path(c.rig_file).parent_path() / (std::filesystem::path(c.rig_file).stem().string() + "_adopted.toml")).string();
  const std::string text = AdoptedRigText(rig_text, fit.hypothesis, added);
  const RigParameters adopted = ReadRigText(text, output);  // must read back
  WriteFileAtomically(output, text);
  progress.Update(0.9, "compare again");
  Case again = c;
  again.rig = adopted;
  CaseModel after_model(again);
  const Comparison after = Compare(after_model, Hypothesis::Base(adopted), true);
  progress.Clear();
  for (const EffectInstance& e : added) {
    fmt::print("{} at {}\n", e.name, e.target);
    for (std::size_t k = 0; k < e.table.size(); ++k)
      fmt::print("  {:<16} {:.6g}{} {}\n", e.table[k].name, e.values[k], e.sd[k] > 0 ? fmt::format(" +- {:.2g}", e.sd[k]) : "", e.table[k].unit);
  }
  for (const LadderStep& s : ladder)
    fmt::print("  {:<34} fit {:8.3f}   unseen {:8.3f}\n", s.added.empty() ? "rig file" : s.added, s.ratio_fit, s.ratio_validate);
  for (const std::string& w : fit.warnings) fmt::print("  warning: {}\n", w);
  if (!fit.converged) fmt::print("  warning: the fit did not converge\n");
  fmt::print("written {}; compared again: ratio {:.3f} (was {:.3f})\n", output, after.ratio, before.ratio);
  nlohmann::ordered_json json = CompareJson(after);
  json["before"] = CompareJson(before);
  json["rig"] = output;
  json["converged"] = fit.converged;
  json["warnings"] = fit.warnings;
  for (const LadderStep& s : ladder) json["ladder"].push_back({{"added", s.added}, {"ratio_fit", s.ratio_fit}, {"ratio_validate", s.ratio_validate}});
  o.common.WriteJson(json);
  if (!o.common.html.empty()) WriteAdoptReport(after_model, before, after, ladder, o.common.html);
  return 0;
}

}  // namespace

void AddAdopt(CLI::App& app, Work& work) {
  auto options = std::make_shared<AdoptCommand>();
  CLI::App* command = app.add_subcommand("adopt", "add an effect with fitted parameters, compare again");
  command->add_option("case", options->file, "case file (TOML)")->required();
  command->add_option("effect", options->effect, "effect of the catalogue (ambrig effects)")->required();
  command->add_option("--target", options->target, "where; default: the target that fits best");
  command->add_option("-o,--output", options->output, "new rig file (default: RIG_adopted.toml beside the rig)");
  options->common.AddTo(*command);
  command->footer("Example:\n  ambrig adopt case.toml eddy-currents --target A -o rig_with_eddy.toml");
  command->callback([options, &work] { work = [options] { return RunAdopt(*options); }; });
}

}  // namespace ambrig
