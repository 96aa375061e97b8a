#pragma once
/// In which order the records of a case are simulated side by side.
#include <cstddef>
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

/// The records of a case, those that take longest to simulate first: then all cores end at nearly
/// the same time. `touches`: of each record, whether its rotor touches something.
std::vector<std::size_t> LongestFirst(const Case& c, const std::vector<char>& touches);

}  // namespace ambrig
