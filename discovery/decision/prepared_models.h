#pragma once
/// Two models of a case, of all its rows and of fewer, made ready for fits.
#include "discovery/decision/compare.h"

namespace ambrig {

/// Rows that a search looks at: more would cost time and tell nothing new.
inline constexpr std::size_t kSearchRows = 150000;

/// The thinning of each record (1: every row) with which a model of the case looks at about `rows`
/// rows. It is the same in all, and at most 12; but a record over time that would have less than a
/// quarter of the mean is thinned less, and the longer ones beside it as much as it takes: what a
/// law leaves is alike over a whole record, so that a record is not worth as many times more as it
/// is longer.
std::vector<std::size_t> ThinningTo(const Case& c, std::size_t rows);

/// The floors of `full` in the model of fewer rows, and what these are worth.
void PassFloorsOn(const CaseModel& full, CaseModel& thin);

/// Nuisances of the records, of all rows, in both; errors of the coils, of the rows of `thin`, in
/// that one alone: forty columns of all rows would not fit into the memory. `independent`: how many
/// of the residuals are; `doubt` divides the weight where errors of the coils are estimated
/// (discovery/decision/coil_choice.h).
void UseNuisancesInBoth(CaseModel& full, CaseModel& thin,
                        const std::vector<NuisanceKind>& of_records,
                        const std::vector<NuisanceKind>& of_coils, double independent,
                        double doubt);

/// The branches of the rig's tolerances in both, which are returned. Floors are set.
std::vector<BranchSpan> UseBranchesInBoth(CaseModel& full, CaseModel& thin,
                                          const Hypothesis& nominal);

/// Gives both the noise, horizons, floors and rows left out of the comparison with `nominal`, which
/// is returned, the branches of its tolerances, the nuisances that the case declares and the errors
/// of the coils whose spread the rig file states.
Comparison PrepareModels(CaseModel& full, CaseModel& thin, const Hypothesis& nominal);

/// Takes off from `thin` what the coils of the machine differ by beside its free parameters at
/// `at`, as Explain does before any effect is sought, in place of what was taken off before.
/// Whether the errors are without doubt (discovery/decision/coil_choice.h); false too where no
/// spread is stated.
bool RenewCoilErrors(CaseModel& thin, const Hypothesis& at, double independent);

}  // namespace ambrig
