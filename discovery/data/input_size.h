#pragma once
/// Records whose commanded signals were found larger or smaller than their scenarios say.
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

/// The case with the excitations of every record's scenario 1 + `larger` times as large (one number
/// for each record).
Case WithInputs(const Case& c, const std::vector<double>& larger);

}  // namespace ambrig
