#pragma once
/// The answer of a search, put together from its parts. Owns the ratios of the stages, errors of
/// the data and remarks; reads what was adopted, ranked and logged.
#include <string>
#include <vector>

#include "discovery/explain/adopted_effects.h"
#include "discovery/explain/name_rankings.h"
#include "discovery/explain/nuisance_selection.h"
#include "discovery/explain/search_log.h"
#include "discovery/explain/search_models.h"
#include "discovery/explain/search_progress.h"

namespace ambrig {

class ExplanationReport {
 public:
  ExplanationReport(SearchModels& models, const AdoptedEffects& adopted, NameRankings& names,
                    const SearchLog& log, const SearchProgress& progress)
      : models_(models), adopted_(adopted), names_(names), log_(log), progress_(progress) {}

  void NoteData(const std::vector<DataFault>& faults) { data_ = faults; }
  const std::vector<DataFault>& data() const { return data_; }
  /// Error over the noise of the validation records with the rig file's parameters [-].
  void NoteNominal(double ratio_validate) { nominal_ratio_validate_ = ratio_validate; }
  double nominal_ratio_validate() const { return nominal_ratio_validate_; }
  /// The same of fitted and validation records with the rig's parameters fitted.
  void NoteBase(double ratio_fit, double ratio_validate) {
    base_ratio_fit_ = ratio_fit;
    base_ratio_validate_ = ratio_validate;
  }

  /// The search as it is now, without a verdict.
  Explanation SoFar() const;
  /// Verdict `data`: nothing that was fitted is named. `base` is the last fit that is believed,
  /// `ratio_validate` its error over the noise on validation records [-].
  Explanation OfWrongData(const FitResult& base, double ratio_validate) const;
  /// The verdict and what belongs to it: shifts of parameters, what is unexplained, hidden or
  /// confusable. The rankings are moved out. `as_filed`: the rig file's parameters; `now`: with all
  /// that was adopted.
  Explanation Final(const FitResult& as_filed, const FitResult& base, const FitResult& now,
                    const std::vector<NuisanceFound>& nuisances, const UnitErrors& of_units);

 private:
  /// Without names.
  Explanation Parts() const;
  /// What a reader of this verdict asks next.
  void AddToVerdict(const FitResult& base, const FitResult& now, Explanation& out) const;
  /// How large what was not found could still be.
  std::vector<VisibleSize> FindHidden(const FitResult& now) const;
  /// Pairs that these records leave open, and the record that would decide.
  std::vector<Confusable> FindConfusable(const std::vector<RankedEffect>& ranking) const;

  SearchModels& models_;
  const AdoptedEffects& adopted_;
  NameRankings& names_;
  const SearchLog& log_;
  const SearchProgress& progress_;
  std::vector<DataFault> data_;
  double nominal_ratio_validate_ = 0, base_ratio_fit_ = 0, base_ratio_validate_ = 0;
};

}  // namespace ambrig
