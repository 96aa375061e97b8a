#pragma once
/// What the coils of any machine of the type differ by, as the rig file states, is no effect. Owns
/// the errors that are possible, and chooses those that are believable beside the effects that were
/// found: NuisanceSelection then takes them off everything.
#include <vector>

#include "discovery/explain/nuisance_selection.h"

namespace ambrig {

class CoilErrorSelection {
 public:
  CoilErrorSelection(SearchModels& models, NuisanceSelection& nuisances, SearchLog& log,
                     const SearchProgress& progress)
      : models_(models), nuisances_(nuisances), log_(log), progress_(progress) {}

  /// Whether any are possible: the rig file states how much they may be, and they were looked for.
  bool any() const { return !possible_.empty(); }
  /// Whether an effect at this target could be an error of its coil.
  bool MayBeOne(const EffectInstance& e) const;

  /// Looks for errors where the rig file states how much they may be and `base`, which becomes the
  /// fit beside them, leaves more than noise. `as_filed`: the rig file's parameters.
  void Use(const FitResult& as_filed, FitResult& base);
  /// Those that are believable beside these effects, seen from `now`.
  void Allow(const FitResult& now, const std::vector<EffectInstance>& effects);
  /// The same after an effect was adopted that explains much; `now` becomes the fit beside them.
  void Renew(FitResult& now, const std::vector<EffectInstance>& effects);
  /// All of it after the floors have changed.
  void RenewFloors(const Hypothesis& as_filed, const FitResult& now,
                   const std::vector<EffectInstance>& effects);
  /// Whether the errors that any coil may have explain as much as this effect of one coil, number
  /// `index` of `effects`: then they are used, and `without`, a fit of the other effects, becomes
  /// the fit beside them.
  bool ExplainInstead(const std::vector<EffectInstance>& effects, std::size_t index,
                      const FitResult& now, FitResult& without);
  /// Fills in the sd of the errors of coils among `found`, beside everything else that is free in
  /// `now`.
  void StateSd(const FitResult& now, std::vector<NuisanceFound>& found);

 private:
  /// The possible ones, with the floors as they are; `as_filed` beside none of them.
  void Find(const FitResult& as_filed);
  /// Puts them aside: residual and sensitivities of `now` from which none was taken off.
  FitResult Without(const FitResult& now);

  SearchModels& models_;
  NuisanceSelection& nuisances_;
  SearchLog& log_;
  const SearchProgress& progress_;
  std::vector<NuisanceKind> possible_;             // rows of the thinned model
  Eigen::MatrixXd as_filed_jacobian_;              // before any was taken off
  std::vector<std::vector<double>> unit_changes_;  // of other machines of the type
};

}  // namespace ambrig
