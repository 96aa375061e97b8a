#include "discovery/explain/effect_selection.h"

#include <algorithm>

#include "discovery/decision/where_it_acts.h"
#include "discovery/shape/shape_names.h"

namespace ambrig {

namespace {

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

bool EffectSelection::Finished(const FitResult& now) const {
  const CaseModel& model = models_.thinned();
  if (adopted_.ShapeExplainsAll() ||
      IsWithinUnits(model, now.residual, nuisances_.of_coils().of_units))
    return true;
  // Nothing that an effect could still win (see WorthAdopting), with parameters that can be
  // believed. An effect of one sensor shows in few channels of many; beside an effect, what is left
  // in some is a detail of its law.
  return Believable(now) && now.ratio_validate * now.ratio_validate < 1.025 &&
         now.ratio_fit * now.ratio_fit < 1.04 &&
         (!adopted_.empty() || WorstRatio(model, now.residual, Which::kAll) < kChannelNoise);
}

double EffectSelection::GainOfOthers(const FitResult& now, const std::vector<RankedEffect>& ranking,
                                     const RankedEffect& than) const {
  double most = -kInfinity;
  for (const RankedEffect& r : ranking)
    if (&r != &than) most = std::max(most, models_.ScoreOf(now) - r.score);
  return most;
}

bool EffectSelection::AdoptBest(FitResult& now, int round) {
  if (Finished(now)) return false;
  // what nuisances explain that nobody declared leaves a detail as a law does
  const bool differ = models_.full().nuisances.differ() && !models_.data().nuisances.any();
  const RoundSetting setting =
      models_.Round(options_.candidates, progress_.Part(0.08 + 0.3 * round, 0.3));
  EffectRound ranked = RankEffects(setting, now, round);
  JudgeByShape(setting, now, round, ranked.ranking);
  const std::vector<RankedEffect>& ranking = ranked.ranking;
  if (round == 0) names_.NoteScreened(std::move(ranked.screened));
  names_.NoteRound(round, ranking);
  bool worth = false;
  const auto best = std::find_if(ranking.begin(), ranking.end(), [&](const RankedEffect& r) {
    if (!r.fit.Stands()) return false;
    const std::size_t last = r.fit.hypothesis.rig.effects.size() - 1;
    if (!HasSize(r.fit, last) || IsDetailOf(adopted_.all(), FittedEffect(r.fit, last)) ||
        adopted_.HoldMagnetisationOf(r.effect) || adopted_.IsSizeless(r.effect))
      return false;
    const double gain = models_.ScoreOf(now) - r.score;
    worth =
        WorthAdopting(now, ByItsShape(r), gain, round + (differ ? 1 : 0), adopted_.first_fall) ||
        (differ && round == 0 && ClosesAlone(now, r.fit, gain, GainOfOthers(now, ranking, r)));
    return worth || ExplainsItsChannels(models_.thinned(), now, r.fit, gain, round == 0);
  });
  if (best == ranking.end()) return false;
  if (!worth) adopted_.NoteOwnChannels(best->effect);
  if (round == 0) adopted_.shaped = best->shaped;
  adopted_.first_fall =
      std::max(adopted_.first_fall, now.ratio_validate * now.ratio_validate -
                                        best->fit.ratio_validate * best->fit.ratio_validate);
  now = models_.FittedToTheEnd(now, best->fit);
  adopted_.AddLastOf(now);
  log_.Step(Named(best->effect), now);
  // The model with the effect may hold a rotor that the rig file's loses: then all rows count.
  if (models_.CountWhatHolds(now.hypothesis)) {
    FitResult again = models_.FitFrom(now.hypothesis);
    if (!again.Stands()) again = models_.At(now.hypothesis);
    if (again.Stands()) now = std::move(again);
  }
  coils_.Renew(now, adopted_.all());
  adopted_one_();
  return true;
}

bool EffectSelection::AdoptMore(FitResult& now) {
  const std::size_t before = adopted_.size();
  for (int round = static_cast<int>(adopted_.size()); round < options_.rounds; ++round)
    if (!AdoptBest(now, round)) break;
  return adopted_.size() > before;
}

}  // namespace ambrig
