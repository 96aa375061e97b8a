#include "discovery/search/ranked_effect.h"

#include <algorithm>
#include <cmath>

#include "discovery/search/likelihood.h"
#include "discovery/search/probes.h"

namespace ambrig {

std::string Named(const EffectInstance& e) { return NameAtTarget(e.name, e.target); }

double BothRatios(double fitted, double unseen) {
  return std::hypot(fitted, unseen) / std::sqrt(2.0);
}

double BothRatios(const FitResult& fit) { return BothRatios(fit.ratio_fit, fit.ratio_validate); }

int RankedEffect::FreeExtras() const {
  if (effect.IsFormula()) return 0;
  const EffectDescription& d = EffectNamed(effect.name);
  const auto extra = [&](const FreeParameter& f) {
    if (f.effect < 0) return false;
    const EffectInstance& e = fit.hypothesis.rig.effects[static_cast<std::size_t>(f.effect)];
    const EffectParameter& p = e.table[f.row];
    return IsSameName(e, effect) && !d.Switches(p) && ShapesFurther(p);
  };
  return static_cast<int>(std::ranges::count_if(fit.hypothesis.free, extra));
}

void SetProbabilities(const FitResult& before, std::vector<RankedEffect>& ranking) {
  if (ranking.empty()) return;
  std::vector<double> scores, shares;
  std::vector<int> extras;
  for (const RankedEffect& r : ranking) {
    scores.push_back(r.score);
    extras.push_back(r.FreeExtras());
    shares.push_back(ExplainedShare(BothRatios(before), BothRatios(r.RatioFit(), r.RatioUnseen())));
  }
  const std::vector<double> probability = Probabilities(scores, shares, extras);
  for (std::size_t k = 0; k < ranking.size(); ++k) ranking[k].probability = probability[k];
}

void SortByScore(std::vector<RankedEffect>& ranking) {
  std::ranges::stable_sort(ranking, {}, &RankedEffect::score);
}

}  // namespace ambrig
