#include "discovery/refine/adopt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "discovery/case/effect_target.h"
#include "discovery/case/test_records.h"
#include "discovery/decision/last_fit.h"
#include "discovery/decision/parameter_shifts.h"
#include "discovery/decision/prepared_models.h"
#include "discovery/model/coil_errors.h"
#include "discovery/model/residual.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/screen.h"
#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

constexpr double kToldShift =
    2;  // sd of a parameter's tolerance, beyond which a user is to look at it

bool SameFolder(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  return fs::absolute(a).lexically_normal().parent_path() ==
         fs::absolute(b).lexically_normal().parent_path();
}

/// @throws InputError for an effect that cannot be fitted at this target
void RequireAdoptable(const Case& c, const EffectDescription& d, const std::string& target) {
  const bool formula = d.id == "formula";
  if (d.users_own && !formula)
    throw InputError(d.id +
                     " is what `ambrig refine` writes, allowed: an effect that `ambrig "
                     "explain` proposes");
  const auto is_formula = [](const EffectInstance& e) { return e.IsFormula(); };
  if (formula && std::none_of(c.rig.effects.begin(), c.rig.effects.end(), is_formula))
    throw InputError(c.rig_file + ": has no [[effect]] name = \"formula\" to fit; write one first");
  if (!formula)
    RequireTarget(d, c.rig, target, fmt::format("--target = {}, allowed with {}:", target, d.id));
}

/// The errors of all rows, which a search sees a part of. @throws InputError when nothing was
/// predicted: the rotor is lost
LadderStep StepTo(const std::string& added, const CaseModel& full,
                  const std::optional<std::vector<double>>& predicted) {
  if (!predicted) throw InputError(full.data().file + ": the model loses levitation with " + added);
  const std::vector<double> residual = Residual(full, *predicted);
  return {added, Ratio(full, residual, Which::kFit), UnseenRatio(full, residual)};
}

/// The last fit, beside what the coils of the machine differ by, which its rig then holds where
/// that is without doubt.
FitResult FitToTheEnd(CaseModel& model, const FitResult& found, double independent) {
  const bool known = RenewCoilErrors(model, found.hypothesis, independent);
  FitResult last = LastFit(model, found, independent);
  if (known) AddCoilErrors(AmountsOfNuisances(model, last.predicted), last.hypothesis.rig);
  return last;
}

}  // namespace

Adoption Adopt(const Case& c, const std::string& effect, const std::string& target,
               const std::string& output, const ExplainOptions& options) {
  if (const std::optional<Case> seen = WithoutTestRecords(c))
    return Adopt(*seen, effect, target, output, options);
  const auto progress = [&](double f, const std::string& text) {
    if (options.stop && options.stop->load()) throw Interrupted();
    if (options.progress) options.progress(f, text);
  };
  const EffectDescription& d = EffectNamed(effect);
  const bool formula = d.id == "formula";
  RequireAdoptable(c, d, target);
  Adoption a;
  CaseModel full(c), model(c, ThinningTo(c, kSearchRows));
  full.stop = model.stop = options.stop;
  const Hypothesis nominal = Hypothesis::Base(c.rig);
  const std::string rig_text = ReadFile(c.rig_file);
  AdoptedRigText(rig_text, nominal, c.rig.effects);  // can be written: known before the long work
  a.before = PrepareModels(full, model, nominal);
  FitOptions fit;
  fit.effective_sample_size = a.before.effective_sample_size;
  progress(0.2, "rig parameters");
  const FitResult base = Fit(model, nominal, fit);
  a.ladder = {StepTo("", full, a.before.predicted),
              StepTo("parameters", full, full.Predict(base.hypothesis))};
  if (formula) {
    // it stands in the rig file and was fitted with the rig parameters
    a.fit = FitToTheEnd(model, base, fit.effective_sample_size);
  } else {
    ScreenOptions what;
    what.effective_sample_size = fit.effective_sample_size;
    what.effect = effect;
    what.target = target;
    what.progress = [&](double f, const std::string& text) { progress(0.3 + 0.3 * f, text); };
    a.fit = FitScreened(model, base, what);
    if (!a.fit.converged)
      throw InputError(
          fmt::format("{}: the model loses levitation in every fit of {}", c.file, effect));
    progress(0.7, "final fit");
    a.fit = FitToTheEnd(model, FitOn(model, base, a.fit.hypothesis, fit.effective_sample_size),
                        fit.effective_sample_size);
    const EffectInstance& e = a.fit.hypothesis.rig.effects.back();
    a.ladder.push_back(
        StepTo(NameAtTarget(e.name, e.target), full, full.Predict(a.fit.hypothesis)));
  }
  for (std::size_t k = 0; k < a.fit.hypothesis.rig.effects.size(); ++k)
    a.effects.push_back(FittedEffect(a.fit, k));
  a.parameter_shifts = ParameterShifts(a.fit.hypothesis, kToldShift);
  a.rig_text = AdoptedRigText(rig_text, a.fit.hypothesis, a.effects);
  if (!SameFolder(c.rig_file, output)) a.rig_text = WithAbsoluteFiles(a.rig_text, c.rig_file);
  progress(0.9, "compare again");
  a.adopted_case = std::make_unique<Case>(c);
  a.adopted_case->rig = ReadRigText(a.rig_text, output);  // must read back
  a.model = std::make_unique<CaseModel>(*a.adopted_case);
  a.after = Compare(*a.model, Hypothesis::Base(a.adopted_case->rig), true);
  return a;
}

}  // namespace ambrig
