#pragma once
/// Adopted effects that are removed again: they have no size, the others make them needless, or
/// several explain as much in their place. Keeps nothing but what it works with.
#include <optional>

#include "discovery/explain/adopted_effects.h"
#include "discovery/explain/coil_error_selection.h"
#include "discovery/explain/name_rankings.h"

namespace ambrig {

/// In every step `base` is the fit of the rig parameters alone, and `now` the fit with all that is
/// adopted.
class EffectRemoval {
 public:
  EffectRemoval(SearchModels& models, CoilErrorSelection& coils, AdoptedEffects& adopted,
                NameRankings& names, SearchLog& log, const SearchProgress& progress)
      : models_(models),
        coils_(coils),
        adopted_(adopted),
        names_(names),
        log_(log),
        progress_(progress) {}

  /// Effects that the last fit leaves without a size. Whether there were any.
  bool DropSizeless(const FitResult& base, FitResult& now);
  /// Effects that their successors made needless.
  void DropSuperseded(const FitResult& base, FitResult& now);
  /// Further effects in whose place several others explain as much cannot be named: a detail of the
  /// law beside them as a rule.
  void DropUnnamed(const FitResult& base, FitResult& now);
  /// Of several effects those without which the fit beside nuisances is as good. An effect whose
  /// channels the nuisances explain a part of gains less than it did, and stays. Whether there were
  /// any.
  bool DropNeedlessBesideNuisances(const FitResult& base, FitResult& now);

 private:
  /// The rig parameters with all adopted effects but this one; nothing where a short fit shows that
  /// it is needed.
  std::optional<FitResult> FitWithout(const FitResult& base, const FitResult& now,
                                      std::size_t adopted) const;
  void TakeOut(std::size_t adopted, FitResult without, FitResult& now);

  SearchModels& models_;
  CoilErrorSelection& coils_;
  AdoptedEffects& adopted_;
  NameRankings& names_;
  SearchLog& log_;
  const SearchProgress& progress_;
};

}  // namespace ambrig
