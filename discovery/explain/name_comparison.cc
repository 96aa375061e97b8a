#include "discovery/explain/name_comparison.h"

#include <algorithm>

#include "discovery/decision/rejudge.h"
#include "discovery/shape/shape_names.h"

namespace ambrig {

void NameComparison::CompareOnly(const FitResult& base, FitResult& now) {
  const EffectInstance only = adopted_[0];
  progress_(0.92, "names in place of " + Named(only));
  std::vector<RankedEffect> ranking =
      RankBeside(models_.thinned(), {base, now, adopted_.all()}, 0, names_.RivalsOf(adopted_, 0),
                 models_.effective_sample_size());
  JudgeByShape(models_.Round(candidates_, progress_.Part(0.92, 0.02)), base, 0, ranking);
  // a name whose effect has no size is none
  const RankedEffect& best = *std::ranges::find_if(ranking, [&](const RankedEffect& r) {
    return IsSameName(r.effect, only) || HasSize(r.fit, adopted_.PlaceOf(0));
  });
  if (!IsSameName(best.effect, only)) {
    now = models_.FittedToTheEnd(base, best.fit);
    adopted_.Renew(now);
    log_.Step(Named(best.effect) + " in place of " + Named(only), now);
  }
  adopted_.shaped = best.shaped;
  names_.NoteComparison(adopted_, 0, std::move(ranking));
}

bool NameComparison::CompareBeside(const FitResult& base, std::size_t index,
                                   const std::vector<EffectInstance>& rivals, FitResult& now) {
  std::vector<RankedEffect> ranking = RankBeside(models_.thinned(), {base, now, adopted_.all()},
                                                 index, rivals, models_.effective_sample_size());
  if (names_.KeepSharedCurve(ranking)) {
    SortByScore(ranking);
    SetProbabilities(base, ranking);
  }
  const RankedEffect& best = ranking[0];
  const EffectInstance before = adopted_[index];
  const bool swapped =
      !IsSameName(best.effect, before) && !names_.ComparedByShape(best.effect, before) &&
      HasSize(best.fit, adopted_.PlaceOf(index)) && (Believable(best.fit) || !Believable(now));
  if (swapped) {
    log_.Step(Named(best.effect) + " in place of " + Named(before), best.fit);
    now = best.fit;
    adopted_.Renew(now);
  }
  names_.NoteComparison(adopted_, index, std::move(ranking));
  return swapped;
}

void NameComparison::Compare(const FitResult& base, FitResult& now, Names which) {
  constexpr int kPasses = 2;
  if (adopted_.size() == 1 && (which == Names::kAllAgain || names_.first().empty() ||
                               !IsSameName(names_.first()[0].effect, adopted_[0])))
    CompareOnly(base, now);
  names_.ForgetJudgedBeside();
  if (adopted_.size() < 2) return;
  bool swapped = true;
  for (int pass = 0; swapped && pass < kPasses; ++pass) {
    swapped = false;
    for (std::size_t k = 0; k < adopted_.size(); ++k) {
      if (adopted_.IsBesideShape(adopted_[k])) continue;  // its round tells more than plain laws do
      const std::vector<EffectInstance> rivals = names_.RivalsOf(adopted_, k);
      if (rivals.empty() && k > 0) continue;
      progress_(0.92, "names beside " + Named(adopted_[k == 0 ? 1 : 0]));
      if (CompareBeside(base, k, rivals, now)) swapped = true;
    }
  }
  names_.NoteJudgedBeside(adopted_);
}

}  // namespace ambrig
