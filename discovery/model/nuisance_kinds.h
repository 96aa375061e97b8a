#pragma once
/// Which nuisances the records of a case could have: the columns that one sd of each makes of every
/// row.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// Usual sd of the zero of a channel [its unit]; 0: it has none.
double UsualZero(const RigParameters& rig, const std::string& channel);

/// Every kind that the records could have, with the sd that the case declares or a usual one.
/// `model` holds all rows; `predicted` of `h`. Simulates each zero of a sensor inside the loop and
/// one change of the input's size.
std::vector<NuisanceKind> NuisanceKindsOf(const CaseModel& model, const Hypothesis& h,
                                          const std::vector<double>& predicted, bool declared_only);

}  // namespace ambrig
