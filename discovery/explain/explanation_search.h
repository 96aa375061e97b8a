#pragma once
/// The sequence of steps behind Explain. Owns the parts that do the work and the models that they
/// share; decides only which step follows which.
#include <optional>
#include <string>
#include <vector>

#include "discovery/explain/effect_beside_shape.h"
#include "discovery/explain/effect_pairs.h"
#include "discovery/explain/effect_removal.h"
#include "discovery/explain/effect_selection.h"
#include "discovery/explain/explanation_report.h"
#include "discovery/explain/name_comparison.h"
#include "discovery/explain/record_corrections.h"

namespace ambrig {

/// In every step `base` is the fit of the rig parameters alone, and `now` the fit with all that is
/// adopted.
class ExplanationSearch {
 public:
  /// Both are to outlive the search.
  ExplanationSearch(const Case& c, const ExplainOptions& options);
  ExplanationSearch(const ExplanationSearch&) = delete;
  ExplanationSearch& operator=(const ExplanationSearch&) = delete;

  /// Stops early, without an answer, where records have to be corrected first (corrections).
  Explanation Run();
  const RecordCorrections& corrections() const { return corrections_; }

 private:
  /// Noise, floors, errors of the data and declared nuisances. Remarks on what does not count, a
  /// line each.
  std::vector<std::string> Prepare(const Hypothesis& nominal);
  Explanation Search(const Hypothesis& nominal, const FitResult& as_filed);
  /// Rig parameters beside errors of the coils and undeclared nuisances.
  FitResult FitBase(const Hypothesis& nominal, const FitResult& as_filed);
  /// Effects are adopted, removed again and compared.
  void FindEffects(const FitResult& as_filed, FitResult& base, FitResult& now);
  void TryPairs(const FitResult& base, FitResult& now);
  /// A rig whose loop is nearly unstable with the hidden effect passes more noise than the rig
  /// file's: what seems unexplained may be noise of the model found. True when the floor was
  /// renewed.
  bool RenewFloor(const FitResult& as_filed, FitResult& base, FitResult& now);
  /// Beside the effects that were found: nuisances, and the effects that are seen once these are
  /// taken off. What explains little stays only if a further effect is then worth adopting: either
  /// may hide the other. True when the search is to start again with records corrected.
  bool FindWhatDiffers(FitResult& base, FitResult& now);
  /// What was found before the nuisances were may be needless beside them, and have another name.
  void SettleBesideNuisances(const FitResult& base, FitResult& now, bool found_before);
  /// An effect that the last fit leaves without a size stood in the place of another one: the names
  /// beside the remaining ones are compared without it.
  void ReplaceSizeless(const FitResult& base, FitResult& now);
  /// A last fit with fresh sensitivities of everything.
  void Polish(FitResult& now);
  /// Whether records have to be corrected beside the nuisances found.
  bool FindCorrections(const FitResult& base) { return FindLateClocks(base) || FindInputs(base); }
  bool FindLateClocks(const FitResult& base);
  bool FindInputs(const FitResult& base);
  /// Loads and commands of one record that acted otherwise than stated, seen beside the fitted
  /// parameters; whether there are any.
  bool FindWrongInputs(const FitResult& base);
  /// Errors of the data that show beside the effects found and did not beside the rig file's model;
  /// whether there are any.
  bool FindWrongData(const FitResult& now);
  /// Raises the floors to what the rig parameters leave, where all of it looks like noise; whether
  /// it does.
  bool TakeForNoise(const FitResult& base);
  /// Amounts of the nuisances at the end.
  std::vector<NuisanceFound> AmountsAtTheEnd(const FitResult& now);

  const ExplainOptions& options_;
  SearchModels models_;
  SearchProgress progress_;
  SearchLog log_;
  NuisanceSelection nuisances_;
  CoilErrorSelection coils_;
  AdoptedEffects adopted_;
  NameRankings names_;
  ExplanationReport report_;
  EffectSelection selection_;
  EffectPairs pairs_;
  EffectBesideShape beside_shape_;
  EffectRemoval removal_;
  NameComparison comparison_;
  RecordCorrections corrections_;
  std::size_t steps_before_effects_ = 0;  // of the ladder
  bool floor_renewed_ = false;
};

}  // namespace ambrig
