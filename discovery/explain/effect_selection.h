#pragma once
/// Forward selection: round by round the effect that explains most of what is left is adopted, if
/// it is worth it. Keeps nothing but what it works with.
#include <functional>
#include <utility>
#include <vector>

#include "discovery/explain/adopted_effects.h"
#include "discovery/explain/coil_error_selection.h"
#include "discovery/explain/name_rankings.h"

namespace ambrig {

class EffectSelection {
 public:
  /// `adopted_one` is called whenever an effect was adopted.
  EffectSelection(SearchModels& models, NuisanceSelection& nuisances, CoilErrorSelection& coils,
                  AdoptedEffects& adopted, NameRankings& names, SearchLog& log,
                  const SearchProgress& progress, const ExplainOptions& options,
                  std::function<void()> adopted_one)
      : models_(models),
        nuisances_(nuisances),
        coils_(coils),
        adopted_(adopted),
        names_(names),
        log_(log),
        progress_(progress),
        options_(options),
        adopted_one_(std::move(adopted_one)) {}

  /// Adds one effect after the other to `now`, as long as one is worth it. Whether one was.
  bool AdoptMore(FitResult& now);
  /// Whether nothing is left that a further effect could explain.
  bool Finished(const FitResult& now) const;

 private:
  /// False: nothing is left, or no effect is worth it.
  bool AdoptBest(FitResult& now, int round);
  /// The most that another candidate of the ranking than this one gains over `now`.
  double GainOfOthers(const FitResult& now, const std::vector<RankedEffect>& ranking,
                      const RankedEffect& than) const;

  SearchModels& models_;
  NuisanceSelection& nuisances_;
  CoilErrorSelection& coils_;
  AdoptedEffects& adopted_;
  NameRankings& names_;
  SearchLog& log_;
  const SearchProgress& progress_;
  const ExplainOptions& options_;
  std::function<void()> adopted_one_;
};

}  // namespace ambrig
