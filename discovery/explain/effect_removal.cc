#include "discovery/explain/effect_removal.h"

#include "discovery/decision/where_it_acts.h"
#include "discovery/search/candidate_fit.h"

namespace ambrig {

bool EffectRemoval::DropSizeless(const FitResult& base, FitResult& now) {
  // What the law of the first effect leaves may pass for a small effect beside it, but for none
  // that explains its own channels. Where only its free shape explains the records the size of the
  // law says little.
  const auto has_size = [&](std::size_t k) {
    if (k == 0 && adopted_.ShapeExplainsAll()) return true;
    const bool plain =
        k == 0 || adopted_.IsOfOwnChannels(adopted_[k]) || adopted_.IsBesideShape(adopted_[k]);
    const std::size_t place = adopted_.PlaceOf(k);
    return HasSize(now, place) && (plain || HasSizeUnderDoubt(now, place));
  };
  std::size_t sizeless = 0;
  while (sizeless < adopted_.size() && has_size(sizeless)) ++sizeless;
  if (sizeless == adopted_.size()) return false;
  log_.warnings.push_back(Named(adopted_[sizeless]) +
                          " lies within 3 sd of nothing: it is not named");
  adopted_.NoteSizeless(adopted_[sizeless]);
  adopted_.Remove(sizeless);
  Hypothesis h = base.hypothesis;
  for (const EffectInstance& e : adopted_.all()) h.AddEffect(e);
  const FitResult left =
      adopted_.empty() ? base : FitOn(models_.thinned(), base, h, models_.effective_sample_size());
  now = left.Stands() ? left : base;
  if (!left.Stands()) adopted_.Clear();
  adopted_.Renew(now);
  log_.Step("without an effect of no size", now);
  DropSizeless(base, now);
  return true;
}

void EffectRemoval::DropSuperseded(const FitResult& base, FitResult& now) {
  for (std::size_t drop = 0; drop < adopted_.size() && adopted_.size() > 1;) {
    if (adopted_.IsBesideShape(adopted_[drop])) {
      ++drop;
      continue;
    }
    progress_(0.9, "without " + adopted_[drop].name);
    std::optional<FitResult> without = FitWithout(base, now, drop);
    const double gain = without ? models_.Gain(*without, now) : kInfinity;
    if (!without || (!coils_.ExplainInstead(adopted_.all(), drop, now, *without) &&
                     (WorthAdopting(*without, now, gain, 1, 0) ||
                      ExplainsItsChannels(models_.thinned(), *without, now, gain, false)))) {
      ++drop;
      continue;
    }
    TakeOut(drop, std::move(*without), now);
  }
}

void EffectRemoval::DropUnnamed(const FitResult& base, FitResult& now) {
  constexpr double kLeastOwn = 0.3;
  for (std::size_t k = 1; k < adopted_.size();) {
    const EffectInstance e = adopted_[k];
    std::optional<FitResult> without;
    if (names_.IsDoubtful(e, kLeastOwn)) without = FitWithout(base, now, k);
    if (!without) {
      ++k;
      continue;
    }
    log_.warnings.push_back(Named(e) +
                            " is one of several effects that explain as much: it is not named");
    names_.ForgetComparison(e);
    TakeOut(k, std::move(*without), now);
  }
}

bool EffectRemoval::DropNeedlessBesideNuisances(const FitResult& base, FitResult& now) {
  constexpr double kAsGood = 20;  // of the score
  const std::size_t before = adopted_.size();
  for (std::size_t drop = 0; drop < adopted_.size() && adopted_.size() > 1;) {
    std::optional<FitResult> without = FitWithout(base, now, drop);
    if (!without || !without->converged || models_.Gain(*without, now) > kAsGood)
      ++drop;
    else
      TakeOut(drop, std::move(*without), now);
  }
  return adopted_.size() < before;
}

std::optional<FitResult> EffectRemoval::FitWithout(const FitResult& base, const FitResult& now,
                                                   std::size_t adopted) const {
  constexpr double kShare = 0.9, kGain = 200;  // of the error, of the score: plainly needed
  const CaseModel& model = models_.thinned();
  Hypothesis h = base.hypothesis;
  for (std::size_t k = 0; k < adopted_.size(); ++k)
    if (k != adopted) h.AddEffect(adopted_[k]);
  const FitResult brief = FitShortly(model, base, h, models_.effective_sample_size());
  if (brief.converged && !coils_.MayBeOne(adopted_[adopted]) && models_.Gain(brief, now) > kGain &&
      ExplainedShare(brief.ratio_fit, now.ratio_fit) > kShare &&
      ExplainedShare(brief.ratio_validate, now.ratio_validate) > kShare)
    return {};
  FitResult fit =
      FitOn(model, base, brief.converged ? brief.hypothesis : h, models_.effective_sample_size());
  if (!fit.Stands()) return {};  // without it the model cannot follow the records at all
  return fit;
}

void EffectRemoval::TakeOut(std::size_t adopted, FitResult without, FitResult& now) {
  adopted_.Remove(adopted);
  now = std::move(without);
  log_.Step("without the effect that became needless", now);
}

}  // namespace ambrig
