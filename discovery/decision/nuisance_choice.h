#pragma once
/// Which of the usual nuisances a residual asks for: those that explain much and differ from record
/// to record. What is the same in every record is an effect, and left to the search. Where most of
/// a group differ much (zeros of the sensors), the others are used, too, if they differ at all.
#include "discovery/model/case_model.h"

namespace ambrig {

/// The kinds to use of those possible. `residual` of all rows, nothing taken off; `weight`: of a
/// squared error over the floor, per row. Where `effects_found` have left the residual, no further
/// effect explains it, and a kind that explains most of it need not differ much.
std::vector<NuisanceKind> ChooseNuisances(const CaseModel& model,
                                          const std::vector<NuisanceKind>& possible,
                                          const std::vector<double>& residual, double weight,
                                          bool effects_found = false);

/// Variance of the amounts about their mean over their mean square, 0 to 1. Each counts with the
/// variance of its own error, 1/`information`, and of the amounts together: one precise record says
/// no more of the others than a rough one. `q`: weighted squares about the weighted mean
/// (drift_test.h). Source: R. DerSimonian, N. Laird, Controlled Clinical Trials 7 (1986), moment
/// estimate.
double SpreadOf(const std::vector<double>& value, const std::vector<double>& information, double q);

}  // namespace ambrig
