#include "discovery/explain/explanation_search.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>

#include "discovery/decision/conclusion.h"
#include "discovery/decision/last_fit.h"
#include "discovery/explain/outlier_fit.h"
#include "discovery/model/stationary_remainder.h"

namespace ambrig {

namespace {

// share of the error that nuisances explain where they are kept before any effect is sought
constexpr double kHalf = 0.5;

double FallOfSquares(const FitResult& before, const FitResult& after) {
  return std::pow(before.ratio_validate, 2) - std::pow(after.ratio_validate, 2);
}

}  // namespace

ExplanationSearch::ExplanationSearch(const Case& c, const ExplainOptions& options)
    : options_(options),
      models_(c, options.stop, options.store),
      progress_(options_, models_),
      nuisances_(models_, log_, progress_),
      coils_(models_, nuisances_, log_, progress_),
      adopted_(c.rig.effects.size()),
      report_(models_, adopted_, names_, log_, progress_),
      selection_(models_, nuisances_, coils_, adopted_, names_, log_, progress_, options_,
                 [this] {
                   if (options_.checkpoint) options_.checkpoint(report_.SoFar());
                 }),
      pairs_(models_, adopted_, log_, progress_),
      beside_shape_(models_, selection_, adopted_, names_, log_, progress_, options_),
      removal_(models_, coils_, adopted_, names_, log_, progress_),
      comparison_(models_, adopted_, names_, log_, progress_, options.candidates) {}

Explanation ExplanationSearch::Run() {
  const auto begin = std::chrono::steady_clock::now();
  progress_(0.0, "noise floor");
  const Hypothesis nominal = Hypothesis::Base(models_.rig());
  const std::vector<std::string> remarks = Prepare(nominal);
  const FitResult as_filed = models_.At(nominal);
  report_.NoteNominal(UnseenRatio(models_.thinned(), as_filed.residual));
  log_.ladder.push_back({"", as_filed.ratio_fit, report_.nominal_ratio_validate()});
  Explanation out;
  if (report_.data().empty()) {
    out = Search(nominal, as_filed);
  } else {
    report_.NoteBase(as_filed.ratio_fit, report_.nominal_ratio_validate());
    out = report_.OfWrongData(as_filed, report_.nominal_ratio_validate());
  }
  out.warnings.insert(out.warnings.end(), remarks.begin(), remarks.end());
  const std::vector<std::string> of_models = models_.Remarks();
  out.warnings.insert(out.warnings.end(), of_models.begin(), of_models.end());
  out.runs = models_.runs();
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  progress_(1.0, "done");
  return out;
}

std::vector<std::string> ExplanationSearch::Prepare(const Hypothesis& nominal) {
  std::vector<std::string> remarks = models_.LimitToHeld(nominal);
  const SearchModels::FoundNoise noise = models_.FindNoise(nominal);
  const std::vector<std::string> starts = models_.PassOverUnstatedStarts(noise.clean);
  progress_(0.02, "are the data possible?");
  report_.NoteData(models_.InspectData(nominal, noise));
  const std::vector<std::string> lonely = models_.PassOverLonely(noise.clean);
  remarks.insert(remarks.end(), lonely.begin(), lonely.end());
  remarks.insert(remarks.end(), starts.begin(), starts.end());
  if (report_.data().empty()) RequireCountedRows(models_.full());
  models_.UseFloors(nominal);
  nuisances_.UseDeclared(nominal, noise.clean);
  return remarks;
}

Explanation ExplanationSearch::Search(const Hypothesis& nominal, const FitResult& as_filed) {
  FitResult base = FitBase(nominal, as_filed);
  if (FindCorrections(base)) return {};
  if (FindWrongInputs(base)) return report_.OfWrongData(base, base.ratio_validate);
  FitResult now = base;
  FindEffects(as_filed, base, now);
  Polish(now);
  ReplaceSizeless(base, now);
  if (!adopted_.empty()) nuisances_.DropNeedless(base, now);
  if (!adopted_.ShapeExplainsAll() && FindWhatDiffers(base, now)) return {};
  if (FindWrongData(now)) return report_.OfWrongData(base, base.ratio_validate);
  log_.warnings.insert(log_.warnings.end(), now.warnings.begin(), now.warnings.end());
  if (floor_renewed_)
    log_.warnings.push_back(
        "the loop of the model found passes more noise than the rig file's: the noise floor is "
        "the found model's");
  const std::vector<NuisanceFound> amounts = AmountsAtTheEnd(now);
  if (adopted_.empty() && TakeForNoise(base)) {
    const FitResult filed = models_.At(as_filed.hypothesis);
    base = now = models_.At(base.hypothesis);
    report_.NoteNominal(UnseenRatio(models_.thinned(), filed.residual));
    report_.NoteBase(base.ratio_fit, base.ratio_validate);
    return report_.Final(filed, base, now, amounts, nuisances_.of_coils().of_units);
  }
  return report_.Final(as_filed, base, now, amounts, nuisances_.of_coils().of_units);
}

bool ExplanationSearch::TakeForNoise(const FitResult& base) {
  constexpr double kNoiseLeft = 1.05;  // error over the floor
  if (RatiosOf(models_.thinned(), base).Answered() < kNoiseLeft) return false;
  const FitResult all = models_.AtAllRows(base);
  if (all.predicted.empty()) return false;
  const StationaryRemainder noise =
      StationaryRemainderOf(models_.full(), all.predicted, all.residual);
  if (noise.channels.empty()) return false;
  const SearchModels::Floors before = models_.floors();
  models_.SetFloors(noise.floors);
  nuisances_.RenewFloors(before.targets);
  const std::vector<std::string> remarks = RemainderRemarks(noise);
  log_.warnings.insert(log_.warnings.end(), remarks.begin(), remarks.end());
  return true;
}

FitResult ExplanationSearch::FitBase(const Hypothesis& nominal, const FitResult& as_filed) {
  progress_(0.03, "rig parameters");
  FitResult base = models_.FitFrom(nominal, &as_filed.jacobian);
  if (base.ratio_validate > report_.nominal_ratio_validate() &&
      base.ratio_fit > 0.999 * as_filed.ratio_fit)
    base = as_filed;
  FitPastOutliers(models_, base);
  PassOverOutliers(models_, nuisances_, base);
  log_.Step("parameters", base);
  coils_.Use(as_filed, base);
  report_.NoteBase(base.ratio_fit, base.ratio_validate);
  const FitResult bare = base;
  if (!nuisances_.Try(base, kHalf, false)) return base;
  if (nuisances_.GiveUpForOneEffect(bare, base)) return bare;
  adopted_.first_fall = FallOfSquares(bare, base);
  FitPastOutliers(models_, base);  // they are seen now that the rest is explained
  PassOverOutliers(models_, nuisances_, base);
  return base;
}

void ExplanationSearch::FindEffects(const FitResult& as_filed, FitResult& base, FitResult& now) {
  steps_before_effects_ = log_.ladder.size();
  selection_.AdoptMore(now);
  TryPairs(base, now);
  if (RenewFloor(as_filed, base, now)) selection_.AdoptMore(now);
  while (beside_shape_.Adopt(now)) continue;
  removal_.DropSuperseded(base, now);
  comparison_.Compare(base, now);
  removal_.DropUnnamed(base, now);
  if (adopted_.empty()) return;
  FitPastOutliers(models_, now);
  if (PassOverOutliers(models_, nuisances_, now)) base = models_.At(base.hypothesis);
}

void ExplanationSearch::TryPairs(const FitResult& base, FitResult& now) {
  if (names_.first().empty() || (adopted_.size() < 2 && selection_.Finished(now))) return;
  // A pair that explains more of the whole is no reason to give up what explains its own channels.
  if (!adopted_.AnyOfOwnChannels()) pairs_.Try(base, now, steps_before_effects_);
}

bool ExplanationSearch::RenewFloor(const FitResult& as_filed, FitResult& base, FitResult& now) {
  if (adopted_.empty() || now.ratio_validate < 1.5 || adopted_.ShapeExplainsAll() ||
      ExplainedShare(base.ratio_validate, now.ratio_validate) > 0.9)
    return false;
  progress_(0.86, "noise floor of the model found");
  const SearchModels::Floors before = models_.floors();
  const NuisanceSelection::State used = nuisances_.Used();
  if (!models_.RaiseFloors(now.hypothesis)) return false;
  nuisances_.RenewFloors(before.targets);
  const double old = now.ratio_validate;
  const FitResult renewed = models_.At(base.hypothesis);
  // A found model that is all but unstable passes so much noise that nothing would stand out.
  if (std::pow(renewed.ratio_validate, 2) - 1 < 0.25 * (std::pow(base.ratio_validate, 2) - 1)) {
    models_.SetFloors(before);
    nuisances_.UseAgain(used);
    return false;
  }
  base = renewed;
  if (coils_.any()) {
    coils_.RenewFloors(as_filed.hypothesis, now, adopted_.all());
    base = models_.At(base.hypothesis);
  }
  now = models_.FitFrom(now.hypothesis);
  report_.NoteNominal(models_.At(as_filed.hypothesis).ratio_validate);
  report_.NoteBase(base.ratio_fit, base.ratio_validate);
  adopted_.first_fall = FallOfSquares(base, now);
  models_.RescaleSignatures(before);
  if (now.ratio_validate < 0.8 * old) {
    log_.Step("noise floor of this model", now);
    floor_renewed_ = true;
  }
  return true;
}

bool ExplanationSearch::FindWhatDiffers(FitResult& base, FitResult& now) {
  constexpr double kPlain = 0.3, kLittle = 0.05;  // share of the error above the noise
  const std::size_t effects = adopted_.size();
  NameRankings::State names = names_.Now();
  std::optional<NuisanceSelection::Before> before =
      nuisances_.Try(now, effects > 0 ? kLittle : kPlain, effects > 0);
  if (!before) return false;
  const CaseModel& model = models_.thinned();
  const bool plain = ExplainedShare(RatiosOf(model, before->fit).Answered(),
                                    RatiosOf(model, now).Answered()) >= kPlain;
  if (plain && FindCorrections(now)) return true;
  const FitResult bare = base;
  if (!nuisances_.given_up_for_effect() || adopted_.empty())
    base = models_.FitFrom(base.hypothesis);
  selection_.AdoptMore(now);
  if (plain || adopted_.size() > effects) {
    if (!plain && FindLateClocks(now)) return true;
    SettleBesideNuisances(base, now, effects > 0);
    return false;
  }
  nuisances_.UseAgain(before->used);
  models_.signatures() = std::move(before->signatures);
  now = std::move(before->fit);
  base = bare;
  log_.TakeBackLast();
  names_.BackTo(std::move(names));
  return false;
}

void ExplanationSearch::SettleBesideNuisances(const FitResult& base, FitResult& now,
                                              bool found_before) {
  if (found_before && removal_.DropNeedlessBesideNuisances(base, now)) selection_.AdoptMore(now);
  if (found_before) comparison_.Compare(base, now, NameComparison::Names::kAllAgain);
  Polish(now);
  ReplaceSizeless(base, now);
}

void ExplanationSearch::ReplaceSizeless(const FitResult& base, FitResult& now) {
  while (removal_.DropSizeless(base, now) && !adopted_.empty() && selection_.AdoptMore(now))
    Polish(now);
}

void ExplanationSearch::Polish(FitResult& now) {
  if (adopted_.empty()) return;
  progress_(0.94, "final fit");
  now = LastFit(models_.thinned(), now, models_.effective_sample_size());
  adopted_.Renew(now);
  log_.LastEndsWith(now);
}

bool ExplanationSearch::FindLateClocks(const FitResult& base) {
  if (!options_.clocks || !models_.full().nuisances.differ()) return false;
  if (auto late = LateClocks(models_.data(), AmountsOfNuisances(models_.thinned(), base.predicted)))
    corrections_.clocks_late = std::move(*late);
  return corrections_.any();
}

bool ExplanationSearch::FindInputs(const FitResult& base) {
  if (options_.inputs <= 0) return false;
  if (auto larger = LargerInputs(models_, nuisances_.of_records(), base))
    corrections_.inputs_larger = std::move(*larger);
  return corrections_.any();
}

bool ExplanationSearch::FindWrongInputs(const FitResult& base) {
  const FitResult all = models_.AtAllRows(base);
  if (all.predicted.empty()) return false;
  report_.NoteData(InspectInputs(models_.full(), all.predicted, all.hypothesis));
  return !report_.data().empty();
}

// An effect that moves every column hides what a logger did to one of them until it is in the
// model. What was fitted beside wrong data is not named. Where nothing was adopted, the wrong data
// may be why: then the best name is looked at.
bool ExplanationSearch::FindWrongData(const FitResult& now) {
  std::vector<std::string> names;
  for (const EffectInstance& e : adopted_.all()) names.push_back(Named(e));
  const bool best = names.empty() && !names_.first().empty();
  if (best) names.push_back(Named(names_.first()[0].effect));
  if (names.empty()) return false;
  const FitResult all = models_.AtAllRows(best ? names_.first()[0].fit : now);
  if (all.predicted.empty()) return false;
  report_.NoteData(InspectData(models_.full(), all.predicted, all.hypothesis));
  if (report_.data().empty()) return false;
  log_.warnings.push_back(
      fmt::format("the wrong data show beside {}, which they may have distorted: mend them and "
                  "explain again",
                  fmt::join(names, " and ")));
  return true;
}

std::vector<NuisanceFound> ExplanationSearch::AmountsAtTheEnd(const FitResult& now) {
  if (!models_.thinned().nuisances.any()) return {};
  std::vector<NuisanceFound> amounts = AmountsOfNuisances(models_.thinned(), now.predicted);
  coils_.StateSd(now, amounts);
  return amounts;
}

}  // namespace ambrig
