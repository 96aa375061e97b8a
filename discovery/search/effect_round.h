#pragma once
/// One round of explain: every effect screened linearly, the best fitted to the records, ranked by
/// what they explain. Method: docs/theory/discovery.md.
#include <functional>
#include <string>
#include <vector>

#include "discovery/search/ranked_effect.h"
#include "discovery/search/screen.h"

namespace ambrig {

/// What a round works with.
struct RoundSetting {
  const CaseModel &full, &model;  // all rows: frequencies; some: the fits
  SignatureBank& bank;
  double effective_sample_size = 1;  // independent numbers among the residuals
  int candidates = 5;                // fitted in full
  std::function<void(double, const std::string&)> progress;  // of this round, 0 to 1
};

struct EffectRound {
  std::vector<RankedEffect> ranking;  // best first
  std::vector<Candidate> screened;
};

/// Effects to add to `now`, which has `round` effects already.
EffectRound RankEffects(const RoundSetting& setting, const FitResult& now, int round);

}  // namespace ambrig
