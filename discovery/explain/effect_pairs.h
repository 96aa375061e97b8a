#pragma once
/// The effect that explains most alone may be none of two that are there: the best pairs of the
/// screening are fitted too where one effect does not explain nearly all. Keeps nothing but what it
/// works with.
#include "discovery/explain/adopted_effects.h"
#include "discovery/explain/search_log.h"
#include "discovery/explain/search_models.h"
#include "discovery/explain/search_progress.h"

namespace ambrig {

class EffectPairs {
 public:
  EffectPairs(SearchModels& models, AdoptedEffects& adopted, SearchLog& log,
              const SearchProgress& progress)
      : models_(models), adopted_(adopted), log_(log), progress_(progress) {}

  /// Takes the best pair in place of all that was adopted where it explains more; `base`: rig
  /// parameters alone. The ladder then begins again behind its first `steps_before_effects`.
  void Try(const FitResult& base, FitResult& now, std::size_t steps_before_effects);
  /// Whether the steps one by one have fitted this pair, or one with more in it.
  bool AlreadyTried(const CandidatePair& p) const;

 private:
  /// Whether a short fit of a pair leaves a full one a chance; `more`: it has more effects than
  /// were adopted.
  bool MayBeAdopted(const FitResult& now, const FitResult& brief, bool more) const;

  /// Where nothing was adopted and one effect of a pair has no size: a fit of the other one alone.
  /// Beside a first effect of no size a law may be found whose signature alone promises nothing.
  FitResult WithSizeAlone(const FitResult& base, FitResult pair) const;
  /// Whether all effects of a full fit have a size and explain more than what was adopted.
  bool IsBetter(const FitResult& now, const FitResult& fit) const;

  SearchModels& models_;
  AdoptedEffects& adopted_;
  SearchLog& log_;
  const SearchProgress& progress_;
};

}  // namespace ambrig
