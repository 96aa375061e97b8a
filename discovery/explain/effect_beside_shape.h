#pragma once
/// Effects that the details of another effect's law hide: they are sought beside the free shape of
/// that law. Keeps nothing but what it works with. Method: docs/theory/discovery.md.
#include <optional>

#include "discovery/explain/effect_selection.h"

namespace ambrig {

class EffectBesideShape {
 public:
  EffectBesideShape(SearchModels& models, const EffectSelection& selection, AdoptedEffects& adopted,
                    NameRankings& names, SearchLog& log, const SearchProgress& progress,
                    const ExplainOptions& options)
      : models_(models),
        selection_(selection),
        adopted_(adopted),
        names_(names),
        log_(log),
        progress_(progress),
        options_(options) {}

  /// Adds the effect that explains most beside the free shape of a law found before. False: none is
  /// worth it there.
  bool Adopt(FitResult& now);

 private:
  /// The fit with the law of one adopted effect in a free shape, all of its sizes free; the best of
  /// these effects. Nothing where no shape gains much.
  std::optional<FitResult> BesideFreeShape(const FitResult& now) const;
  /// Whether the effect that this fit adds to `beside` explains enough of what the shape leaves.
  bool IsWorthIt(const FitResult& beside, const RankedEffect& ranked, int round) const;

  SearchModels& models_;
  const EffectSelection& selection_;
  AdoptedEffects& adopted_;
  NameRankings& names_;
  SearchLog& log_;
  const SearchProgress& progress_;
  const ExplainOptions& options_;
};

}  // namespace ambrig
