#pragma once
/// An effect with its fit in the ranking of a round, and the probabilities of a ranking.
#include <optional>
#include <string>
#include <vector>

#include "discovery/search/fit.h"
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

  /// Free parameters of the effect that only shape its law further (probes.h).
  int FreeExtras() const;
};

/// "eddy-currents at A"
std::string Named(const EffectInstance& e);

/// Of fitted and unseen records alike.
double BothRatios(double fitted, double unseen);
double BothRatios(const FitResult& fit);

/// Probabilities of a ranking's members (best first) from their scores and from the shares of the
/// error of `before` that they explain.
void SetProbabilities(const FitResult& before, std::vector<RankedEffect>& ranking);

/// Best first by the scores, equal ones as they stand.
void SortByScore(std::vector<RankedEffect>& ranking);

}  // namespace ambrig
