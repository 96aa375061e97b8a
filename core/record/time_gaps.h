#pragma once
/// Rows that a logger lost while its clock went on.
#include <vector>

#include "core/record/record.h"

namespace ambrig {

/// Where times `t` [s] of the record's rows, otherwise a step apart, jump by a whole number of
/// steps, rows without numbers (nan) are put into all channels, and their times into `t`;
/// `record.gaps` tells where. Nothing is changed where the times are not of that form: few rows,
/// many jumps, other distances.
void FillGaps(Record& record, std::vector<double>& t);

}  // namespace ambrig
