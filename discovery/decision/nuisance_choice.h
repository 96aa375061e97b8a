#pragma once
/// Which of the usual nuisances a residual asks for: those that explain much and differ from record
/// to record. What is the same in every record is an effect, and left to the search.
#include "discovery/model/model.h"

namespace ambrig {

/// The kinds to use of those possible. `residual` of all rows, nothing taken off; `weight`: of a
/// squared error over the floor, per row.
std::vector<NuisanceKind> ChooseNuisances(const CaseModel& model,
                                          const std::vector<NuisanceKind>& possible,
                                          const std::vector<double>& residual, double weight);

}  // namespace ambrig
