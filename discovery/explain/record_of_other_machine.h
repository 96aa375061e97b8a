#pragma once
/// A record of another machine, or of this one in another state (hot, mended, with another rotor):
/// the only one that disagrees with the rig, and rig parameters that no tolerance allows explain it
/// alone.
#include <optional>

#include "discovery/explain/explain.h"

namespace ambrig {

/// Asked where the answer `e` of the case is `unknown` and one record shows what is left. `c`: the
/// records of the search. Fits the rig parameters twice, without this record and to it alone.
std::optional<DataFault> RecordOfOtherMachine(const Case& c, const Explanation& e);

/// The answer becomes `data`, with this fault.
void BelieveFault(const DataFault& fault, Explanation& e);

}  // namespace ambrig
