#pragma once
/// Rows where a fit leaves errors that are large, few and together: the model took another branch
/// there than the machine, for example because a limiter held one period longer. No sensitivity
/// tells such a step, so a fit that sees it moves parameters for it; one that passes it over may
/// find the branch of the machine.
#include <vector>

#include "discovery/model/residual.h"

namespace ambrig {

/// Spans of the channels over time of these records whose errors exceed six floors, with 1 ms
/// before and after, sorted by record and instant. Only channels in which they are at most one row
/// of ten and carry most of the error above the noise. Empty where they make less than a third of
/// all that is left there above the noise. `residual`: of all rows of the model, in floors.
std::vector<SampleSpan> BurstRows(const CaseModel& model, const std::vector<double>& residual,
                                  Which which);

}  // namespace ambrig
