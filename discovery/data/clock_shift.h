#pragma once
/// Records whose clock was found whole rows off.
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

/// The case with every record's rows moved back by `rows_late` (one number for each record;
/// negative: it is early). Rows for which no measured one is left do not count.
Case WithClocks(const Case& c, const std::vector<int>& rows_late);

}  // namespace ambrig
