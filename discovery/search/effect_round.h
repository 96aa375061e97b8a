#pragma once
/// One round of explain: every effect screened linearly, the best fitted to the records, ranked by
/// what they explain. Method: docs/theory/discovery.md.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discovery/search/screen.h"
#include "discovery/search/stage_ratios.h"

namespace ambrig {

struct RankedEffect {
  FitResult fit;          // with the effect (and what was adopted before it)
  EffectInstance effect;  // fitted values and sd
  double score = 0, probability = 0;
  bool from_nominal = false;  // the fit began at the rig file's own parameters
  double screened_ratio = 0;  // what the linear screening promised on unseen records
  // what the law leaves in a free shape (discovery/shape/shape_names.h), where that was tried and
  // is less
  std::optional<StageRatios> shaped;
  bool shares_curve = false;  // a free magnetisation curve is of this name and of another one

  /// Errors over the noise that count for the name: of the free shape, else of the fit.
  double RatioFit() const { return shaped ? shaped->fit : fit.ratio_fit; }
  double RatioUnseen() const { return shaped ? shaped->validate : fit.ratio_validate; }
};

/// "eddy-currents at A"
std::string Named(const EffectInstance& e);

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

/// Probabilities of a ranking's members (best first) from their scores and from the shares of the
/// error of `before` that they explain.
void SetProbabilities(const FitResult& before, std::vector<RankedEffect>& ranking);

/// Best first by the scores, equal ones as they stand.
void SortByScore(std::vector<RankedEffect>& ranking);

/// Effects to add to `now`, which has `round` effects already.
EffectRound RankEffects(const RoundSetting& setting, const FitResult& now, int round);

}  // namespace ambrig
