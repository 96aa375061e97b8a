#pragma once
/// Names of the adopted effects, each compared again with its rivals: beside the other effects, or
/// with the shapes of the laws free. Keeps nothing but what it works with.
#include "discovery/explain/adopted_effects.h"
#include "discovery/explain/name_rankings.h"
#include "discovery/explain/search_log.h"
#include "discovery/explain/search_models.h"
#include "discovery/explain/search_progress.h"

namespace ambrig {

class NameComparison {
 public:
  /// `candidates`: effects fitted in full where shapes of laws are compared.
  NameComparison(SearchModels& models, AdoptedEffects& adopted, NameRankings& names, SearchLog& log,
                 const SearchProgress& progress, int candidates)
      : models_(models),
        adopted_(adopted),
        names_(names),
        log_(log),
        progress_(progress),
        candidates_(candidates) {}

  /// What no round has judged beside the fit as it is, or all names: what was taken off since tells
  /// them apart.
  enum class Names { kNotJudged, kAllAgain };
  /// Names that were open while effects found later were missing: each effect against its rivals
  /// beside the others; a better one takes its place, and then all are compared once more. What is
  /// left alone of a pair was found by the pair's fit: no round has compared it with other names.
  /// `base`: rig parameters alone.
  void Compare(const FitResult& base, FitResult& now, Names which = Names::kNotJudged);

 private:
  /// The only effect against its rivals, and with the shapes of the laws.
  void CompareOnly(const FitResult& base, FitResult& now);
  /// Effect number `index` beside the others. Whether a better name took its place.
  bool CompareBeside(const FitResult& base, std::size_t index,
                     const std::vector<EffectInstance>& rivals, FitResult& now);

  SearchModels& models_;
  AdoptedEffects& adopted_;
  NameRankings& names_;
  SearchLog& log_;
  const SearchProgress& progress_;
  int candidates_;
};

}  // namespace ambrig
