#pragma once
/// What differs from record to record or from coil to coil without being physics that the model
/// lacks. Owns the kinds that both models use now, and chooses those of the records where the case
/// declares none. Errors of single coils are chosen by CoilErrorSelection (coil_error_selection.h).
#include <optional>
#include <vector>

#include "discovery/decision/unit_errors.h"
#include "discovery/explain/search_log.h"
#include "discovery/explain/search_models.h"
#include "discovery/explain/search_progress.h"

namespace ambrig {

/// Errors of single coils that are taken off the thinned model.
struct UsedCoilErrors {
  std::vector<NuisanceKind> kinds;  // rows of the thinned model
  double doubt = 1;                 // by which they are weighed less
  double seen_at = 1;   // [-] rms over the floor that the model left when they were chosen
  UnitErrors of_units;  // what they leave of other machines of the type
};

class NuisanceSelection {
 public:
  NuisanceSelection(SearchModels& models, SearchLog& log, const SearchProgress& progress)
      : models_(models), log_(log), progress_(progress) {}

  /// Kinds of the records, all rows.
  const std::vector<NuisanceKind>& of_records() const { return of_records_; }
  const UsedCoilErrors& of_coils() const { return of_coils_; }

  /// What stands in both models now, to be put back after a trial without it.
  struct State {
    std::vector<NuisanceKind> of_records;
    UsedCoilErrors of_coils;
    SearchModels::UsedNuisances models;
  };
  State Used() const { return {of_records_, of_coils_, models_.nuisances()}; }
  void UseAgain(const State& used);

  /// Those that the case declares, where it does. `predicted` of `h`, all rows.
  void UseDeclared(const Hypothesis& h, const std::vector<double>& predicted);
  /// These of the records beside the errors of the coils. They come off the signatures; without any
  /// the signatures are forgotten.
  void UseOfRecords(const std::vector<NuisanceKind>& kinds);
  /// The same amounts over the floors that the models have now. `before`: their targets until then.
  /// The signatures stay as they are.
  void RenewFloors(const std::vector<Target>& before);
  /// These errors of coils beside those of the records, members as in UsedCoilErrors. The
  /// signatures stay as they are.
  void UseOfCoils(const std::vector<NuisanceKind>& kinds, double doubt, double seen_at);
  /// What those leave of other machines of the type.
  void SetOfUnits(const UnitErrors& of_units) { of_coils_.of_units = of_units; }
  /// No errors of coils; what was known of other machines stays.
  void UseNoneOfCoils();

  /// The search before nuisances were taken off.
  struct Before {
    State used;
    SignatureBank signatures;
    FitResult fit;
  };
  /// Zeros, clocks and inputs that differ from record to record, where the case declares none. They
  /// are kept where they explain `least_share` of the error above the noise, and a linear step
  /// promises a good part of it. Before effects are found, amounts that are the same in all records
  /// are left to these. `now` becomes the fit beside them. The search before them is
  /// returned; nothing where they are not kept.
  std::optional<Before> Try(FitResult& now, double least_share, bool effects_found);
  /// Whether one effect explains as much as the nuisances of every record together, which are many:
  /// they are then given up, and the search for effects starts from `bare`.
  bool GiveUpForOneEffect(const FitResult& bare, const FitResult& with_nuisances);
  /// Whether an effect was sought in place of nuisances that explain as much: beside those nothing
  /// is left for it.
  bool given_up_for_effect() const { return given_up_for_effect_; }
  /// Nuisances that the case does not declare are removed when the fit `now` with effects is as
  /// good without.
  void DropNeedless(FitResult& base, FitResult& now);

 private:
  /// Those of these kinds, of all rows, that the errors of the thinned model ask for: errors of
  /// coils are taken off there.
  std::vector<NuisanceKind> ChooseFrom(const std::vector<NuisanceKind>& kinds, const FitResult& now,
                                       bool effects_found) const;
  void Apply();

  SearchModels& models_;
  SearchLog& log_;
  const SearchProgress& progress_;
  std::vector<NuisanceKind> of_records_;
  UsedCoilErrors of_coils_;
  bool given_up_for_effect_ = false;
};

}  // namespace ambrig
