// Steps of the search: effects are added, exchanged and taken away.
#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "discovery/decision/conclusion.h"
#include "discovery/decision/last_fit.h"
#include "discovery/decision/likelihood.h"
#include "discovery/decision/where_it_acts.h"
#include "discovery/explain/explanation_search.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/linear_step.h"
#include "discovery/shape/shape_names.h"

namespace ambrig {

namespace {
// Error over the noise that the free shape of one law leaves, below which no further effect is sought.
constexpr double kShapeExplains = 1.08;

/// A fit as far as it is judged by, with the errors that the shape of its law leaves.
FitResult ByItsShape(const RankedEffect& r) {
  FitResult out;
  out.hypothesis = r.fit.hypothesis;
  out.converged = r.fit.converged;
  out.penalty = r.fit.penalty;
  out.ratio_fit = r.RatioFit();
  out.ratio_validate = r.RatioUnseen();
  return out;
}
}  // namespace

bool Explainer::ShapeExplainsAll() const {
  return out_.adopted.size() == 1 && out_.shaped && out_.shaped->Answered() < kShapeExplains;
}

bool Explainer::Finished(const FitResult& now) const {
  if (ShapeExplainsAll() || IsWithinUnits(model_, now.residual, of_units_)) return true;
  // Nothing that an effect could still win (see WorthAdopting), with parameters that can be
  // believed. An effect of one sensor shows in few channels of many; beside an effect, what is left
  // in some is a detail of its law.
  return Believable(now) && now.ratio_validate * now.ratio_validate < 1.025 &&
         now.ratio_fit * now.ratio_fit < 1.04 &&
         (!out_.adopted.empty() || WorstRatio(model_, now.residual, Which::kAll) < kChannelNoise);
}

/// The most that another candidate than this one gains over `now`.
double Explainer::GainOfOthers(const FitResult& now, const std::vector<RankedEffect>& ranking,
                               const RankedEffect& than) const {
  double most = -kInfinity;
  for (const RankedEffect& r : ranking)
    if (&r != &than) most = std::max(most, ScoreOf(now) - r.score);
  return most;
}

/// Only the best of a round were fitted to the end. `before` lends its sensitivities.
FitResult Explainer::FittedToTheEnd(const FitResult& before, const RankedEffect& ranked) const {
  if (ranked.fit.jacobian.size() > 0) return ranked.fit;
  const FitResult whole = FitOn(model_, before, ranked.fit.hypothesis, out_.effective_sample_size);
  return whole.Stands() ? whole : ranked.fit;
}

void Explainer::NoteRound(const std::vector<RankedEffect>& ranking) {
  rounds_.emplace_back();
  for (const RankedEffect& r : ranking)
    rounds_.back().push_back({r.effect, r.probability, r.RatioFit(), r.shaped.has_value()});
}

RoundSetting Explainer::SettingFrom(double from, double share) {
  return {
      full_,
      model_,
      bank_,
      out_.effective_sample_size,
      options_.candidates,
      [this, from, share](double f, const std::string& text) { Progress(from + share * f, text); }};
}

/// Adds the effect that explains most of what is left; false: nothing left, or none worth it.
bool Explainer::AdoptBest(FitResult& now, int round) {
  if (Finished(now)) return false;
  // what nuisances explain that nobody declared leaves a detail as a law does
  const bool differ = full_.nuisances.differ() && !full_.data().nuisances.any();
  const RoundSetting setting = SettingFrom(0.08 + 0.3 * round, 0.3);
  EffectRound ranked = RankEffects(setting, now, round);
  JudgeByShape(setting, now, round, ranked.ranking);
  const std::vector<RankedEffect>& ranking = ranked.ranking;
  if (round == 0) out_.screened = std::move(ranked.screened);
  (round == 0 ? out_.ranking : out_.second_round) = ranking;
  NoteRound(ranking);
  bool worth = false;
  const auto best = std::find_if(ranking.begin(), ranking.end(), [&](const RankedEffect& r) {
    if (!r.fit.Stands()) return false;
    const std::size_t last = r.fit.hypothesis.rig.effects.size() - 1;
    if (!HasSize(r.fit, last) || IsDetailOf(out_.adopted, FittedEffect(r.fit, last))) return false;
    const double gain = ScoreOf(now) - r.score;
    worth = WorthAdopting(now, ByItsShape(r), gain, round + (differ ? 1 : 0), first_fall_) ||
            (differ && round == 0 && ClosesAlone(now, r.fit, gain, GainOfOthers(now, ranking, r)));
    return worth || ExplainsItsChannels(model_, now, r.fit, gain, round == 0);
  });
  if (best == ranking.end()) return false;
  if (!worth) of_own_channels_.push_back(Named(best->effect));
  if (round == 0) out_.shaped = best->shaped;
  first_fall_ = std::max(first_fall_, now.ratio_validate * now.ratio_validate -
                                          best->fit.ratio_validate * best->fit.ratio_validate);
  now = FittedToTheEnd(now, *best);
  out_.adopted.push_back(FittedEffect(now, now.hypothesis.rig.effects.size() - 1));
  out_.ladder.push_back({Named(best->effect), now.ratio_fit, now.ratio_validate});
  Release(now);
  RenewCoilErrors(now);
  if (options_.checkpoint) options_.checkpoint(out_);
  return true;
}

/// Adds one effect after the other, as long as one is worth it.
void Explainer::AdoptMore(FitResult& now) {
  for (int round = static_cast<int>(out_.adopted.size()); round < options_.rounds; ++round)
    if (!AdoptBest(now, round)) break;
}

/// The model with the effect may hold a rotor that the rig file's loses: then all rows count.
void Explainer::Release(FitResult& now) {
  if (!full_.limited()) return;
  full_.LimitToHeld(now.hypothesis);
  model_.LimitAs(full_);
  now = FitNow(now.hypothesis, nullptr);
  bank_ = SignatureBank();
}

/// A rig whose loop is nearly unstable with the hidden effect passes more noise than the rig
/// file's: what seems unexplained may be noise of the model found. True when the floor was
/// renewed.
bool Explainer::RenewFloor(const FitResult& as_filed, FitResult& base, FitResult& now) {
  if (out_.adopted.empty() || now.ratio_validate < 1.5 || ShapeExplainsAll() ||
      ExplainedShare(base.ratio_validate, now.ratio_validate) > 0.9)
    return false;
  Progress(0.86, "noise floor of the model found");
  const std::vector<Target> before = full_.targets();
  const double sample_size = out_.effective_sample_size;
  try {
    const NoiseFloor floor = FindFloor(full_, now.hypothesis);
    model_.LeaveOut(floor.unpredictable);
    out_.effective_sample_size = floor.effective_sample_size;
  } catch (const InputError&) {
    return false;  // with noise it does not hold its rotor
  }
  const double old = now.ratio_validate;
  for (std::size_t t = 0; t < before.size(); ++t)
    model_.targets()[t].floor = full_.targets()[t].floor =
        std::max(before[t].floor, full_.targets()[t].floor);
  const FitResult renewed = At(base.hypothesis);
  // A found model that is all but unstable passes so much noise that nothing would stand out.
  if (std::pow(renewed.ratio_validate, 2) - 1 < 0.25 * (std::pow(base.ratio_validate, 2) - 1)) {
    for (std::size_t t = 0; t < before.size(); ++t)
      model_.targets()[t].floor = full_.targets()[t].floor = before[t].floor;
    out_.effective_sample_size = sample_size;
    return false;
  }
  base = renewed;
  if (!coil_errors_.empty()) {
    RenewCoilFloors(as_filed.hypothesis, now);
    base = At(base.hypothesis);
  }
  now = FitNow(now.hypothesis, nullptr);
  out_.nominal_ratio_validate = At(as_filed.hypothesis).ratio_validate;
  out_.base_ratio_fit = base.ratio_fit;
  out_.base_ratio_validate = base.ratio_validate;
  first_fall_ = std::pow(base.ratio_validate, 2) - std::pow(now.ratio_validate, 2);
  if (model_.nuisances.any())
    bank_ = SignatureBank();  // they were taken off with the old floors
  else
    bank_.Rescale(model_, before);
  if (now.ratio_validate < 0.8 * old) {
    out_.ladder.push_back({"noise floor of this model", now.ratio_fit, now.ratio_validate});
    floor_renewed_ = true;
  }
  return true;
}

/// The effect that explains most alone may be none of two that are there: the best pairs of the
/// screening are fitted too where one effect does not explain nearly all.
void Explainer::TryPairs(const FitResult& base, FitResult& now) {
  if (out_.ranking.empty() || (out_.adopted.size() < 2 && Finished(now))) return;
  // A pair that explains more of the whole is no reason to give up what explains its own channels.
  if (!of_own_channels_.empty()) return;
  Progress(0.8, "pairs of effects");
  for (const CandidatePair& p : ScreenPairs(model_, base, out_.effective_sample_size, bank_, 3)) {
    // A pair that promises less than what stands is not worth the dearest fit of the search.
    if (AlreadyTried(p) || p.score > std::min(ScoreOf(base), ScoreOf(now))) continue;
    Progress(0.82, "fitting " + Named(p.first) + " with " + Named(p.second));
    Hypothesis h = base.hypothesis;
    h.AddEffect(p.first);
    h.AddEffect(p.second);
    const bool more = out_.adopted.size() < 2;
    FitResult fit = FitShortly(model_, base, h, out_.effective_sample_size);
    if (!MayBeAdopted(now, fit, more)) continue;
    fit = FitOn(model_, base, fit.hypothesis, out_.effective_sample_size);
    if (!fit.converged || Gain(now, fit) < (more ? 20 : 0) || !HasSize(fit, rig_.effects.size()) ||
        !HasSize(fit, rig_.effects.size() + 1) ||
        (more && !WorthAdopting(now, fit, Gain(now, fit), 1, first_fall_)))
      continue;
    now = std::move(fit);
    out_.adopted = {FittedEffect(now, rig_.effects.size()),
                    FittedEffect(now, rig_.effects.size() + 1)};
    out_.ladder.resize(steps_before_effects_);
    out_.ladder.push_back(
        {Named(p.first) + " and " + Named(p.second), now.ratio_fit, now.ratio_validate});
  }
}

bool Explainer::MayBeAdopted(const FitResult& now, const FitResult& brief, bool more) const {
  constexpr double kUnseen = 0.2, kFit = 0.4;  // half of the shares that adoption asks for
  const double gain = Gain(now, brief);
  if (!brief.converged || gain < (more ? 0 : -kOpenAfterShortFit)) return false;
  return !more || !Believable(now) ||
         ExplainedShare(now.ratio_validate, brief.ratio_validate) > kUnseen ||
         ExplainedShare(now.ratio_fit, brief.ratio_fit) > kFit;
}

/// The steps one by one have fitted this pair, or one with more in it.
bool Explainer::AlreadyTried(const CandidatePair& p) const {
  int found = 0;
  for (const EffectInstance& e : out_.adopted)
    for (const EffectInstance* o : {&p.first, &p.second})
      found += e.name == o->name && e.target == o->target ? 1 : 0;
  return found == 2 || (found == 1 && out_.adopted.size() == 1);
}

/// A last fit with fresh sensitivities of everything.
void Explainer::Polish(FitResult& now) {
  if (out_.adopted.empty()) return;
  Progress(0.94, "final fit");
  now = LastFit(model_, now, out_.effective_sample_size);
  for (std::size_t k = 0; k < out_.adopted.size(); ++k)
    out_.adopted[k] = FittedEffect(now, rig_.effects.size() + k);
  out_.ladder.back().ratio_fit = now.ratio_fit;
  out_.ladder.back().ratio_validate = now.ratio_validate;
}

}  // namespace ambrig
