#pragma once
/// The name of an effect judged again beside the other effects that were found. While one of these
/// was missing from the model, its error hid what tells the names of the first apart; beside it the
/// same likelihood rule may decide, or another name may be the better one.
#include <vector>

#include "discovery/search/effect_round.h"

namespace ambrig {

/// A fit with effects that were found; they stand in this order behind the rig file's own.
struct FoundEffects {
  const FitResult& base;  // rig parameters alone
  const FitResult& now;   // with the effects and its sensitivities
  const std::vector<EffectInstance>& effects;
};

/// Effect number `index` of those found, and each of its `rivals` in its place, all beside the
/// other effects; best first, with probabilities by the rule of a round. Rivals start at their
/// values with the rest as `now` has it; the best is fitted to the end. A rival that the plant
/// refuses is left out.
std::vector<RankedEffect> RankBeside(const CaseModel& model, const FoundEffects& found,
                                     std::size_t index, const std::vector<EffectInstance>& rivals,
                                     double effective_sample_size);

}  // namespace ambrig
