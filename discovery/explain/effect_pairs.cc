#include "discovery/explain/effect_pairs.h"

#include <algorithm>

#include "discovery/search/candidate_fit.h"

namespace ambrig {

void EffectPairs::Try(const FitResult& base, FitResult& now, std::size_t steps_before_effects) {
  const CaseModel& model = models_.thinned();
  const double independent = models_.effective_sample_size();
  progress_(0.8, "pairs of effects");
  for (const CandidatePair& p : ScreenPairs(model, base, independent, models_.signatures(), 3)) {
    // A pair that promises less than what stands is not worth the dearest fit of the search.
    if (AlreadyTried(p) || p.score > std::min(models_.ScoreOf(base), models_.ScoreOf(now)))
      continue;
    progress_(0.82, "fitting " + Named(p.first) + " with " + Named(p.second));
    Hypothesis h = base.hypothesis;
    h.AddEffect(p.first);
    h.AddEffect(p.second);
    const bool more = adopted_.size() < 2;
    FitResult fit = FitShortly(model, base, h, independent);
    if (!MayBeAdopted(now, fit, more)) continue;
    fit = WithSizeAlone(base, FitOn(model, base, fit.hypothesis, independent));
    if (!fit.converged || !IsBetter(now, fit)) continue;
    const std::size_t effects = adopted_.In(fit);
    log_.BackTo(steps_before_effects);
    log_.Step(effects == 2 ? Named(p.first) + " and " + Named(p.second)
                           : Named(fit.hypothesis.rig.effects.back()),
              fit);
    now = std::move(fit);
    adopted_.Take(now, effects);
  }
}

FitResult EffectPairs::WithSizeAlone(const FitResult& base, FitResult pair) const {
  if (!pair.converged || !adopted_.empty()) return pair;
  const bool first = HasSize(pair, adopted_.PlaceOf(0)),
             second = HasSize(pair, adopted_.PlaceOf(1));
  if (first == second) return pair;
  Hypothesis h = base.hypothesis;
  h.AddEffect(pair.hypothesis.rig.effects[adopted_.PlaceOf(first ? 0 : 1)]);
  return FitOn(models_.thinned(), base, h, models_.effective_sample_size());
}

bool EffectPairs::IsBetter(const FitResult& now, const FitResult& fit) const {
  const std::size_t effects = adopted_.In(fit);
  const bool more = effects > adopted_.size();
  for (std::size_t k = 0; k < effects; ++k)
    if (!HasSize(fit, adopted_.PlaceOf(k))) return false;
  const double gain = models_.Gain(now, fit);
  if (!more) return gain >= 0;
  return gain >= 20 &&
         WorthAdopting(now, fit, gain, static_cast<int>(effects) - 1, adopted_.first_fall);
}

bool EffectPairs::MayBeAdopted(const FitResult& now, const FitResult& brief, bool more) const {
  constexpr double kUnseen = 0.2, kFit = 0.4;  // half of the shares that adoption asks for
  const double gain = models_.Gain(now, brief);
  if (!brief.converged || gain < (more ? 0 : -kOpenAfterShortFit)) return false;
  return !more || !Believable(now) ||
         ExplainedShare(now.ratio_validate, brief.ratio_validate) > kUnseen ||
         ExplainedShare(now.ratio_fit, brief.ratio_fit) > kFit;
}

bool EffectPairs::AlreadyTried(const CandidatePair& p) const {
  int found = 0;
  for (const EffectInstance& e : adopted_.all())
    for (const EffectInstance* o : {&p.first, &p.second}) found += IsSameName(e, *o) ? 1 : 0;
  return found == 2 || (found == 1 && adopted_.size() == 1);
}

}  // namespace ambrig
