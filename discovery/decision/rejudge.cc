#include "discovery/decision/rejudge.h"

#include <algorithm>

#include "discovery/search/candidate_fit.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

namespace {

/// The effects found with another one as number `index`; rig parameters as the fit has them.
Hypothesis InItsPlace(const FoundEffects& found, std::size_t index, const EffectInstance& rival) {
  Hypothesis h = found.base.hypothesis;
  for (std::size_t k = 0; k < h.free.size(); ++k) h.Set(k, found.now.hypothesis.free[k].value);
  for (std::size_t k = 0; k < found.effects.size(); ++k)
    h.AddEffect(k == index ? rival : found.effects[k]);
  return h;
}

}  // namespace

std::vector<RankedEffect> RankBeside(const CaseModel& model, const FoundEffects& found,
                                     std::size_t index, const std::vector<EffectInstance>& rivals,
                                     double effective_sample_size) {
  constexpr double kStillOpen = 60;  // of the score: what a full fit may gain over a short one
  const std::size_t place = found.now.hypothesis.rig.effects.size() - found.effects.size() + index;
  std::vector<RankedEffect> out;
  const auto note = [&](RankedEffect& r, FitResult fit) {
    r.effect = FittedEffect(fit, place);
    r.score = Score(model, fit, effective_sample_size);
    r.fit = std::move(fit);
  };
  note(out.emplace_back(), found.now);
  const double here = out[0].score;
  for (const EffectInstance& rival : rivals) {
    FitResult fit =
        FitShortly(model, found.now, InItsPlace(found, index, rival), effective_sample_size);
    if (fit.converged) note(out.emplace_back(), std::move(fit));
  }
  const auto better = [](const auto& a, const auto& b) { return a.score < b.score; };
  const auto best = std::min_element(out.begin() + 1, out.end(), better);
  if (best != out.end() && best->score < here + kStillOpen) {
    FitResult fit = FitOn(model, found.now, best->fit.hypothesis, effective_sample_size);
    if (fit.converged) note(*best, std::move(fit));
  }
  SortByScore(out);
  SetProbabilities(found.base, out);
  return out;
}

}  // namespace ambrig
