#pragma once
/// ambrig redistribute for a stator of any kind
/// (faulttolerance/redistribution/stator_distribution.h).
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// `sets`: coils from 1. Prints what runs do with each set and returns the exit code.
int RedistributeStator(const NominalRig& rig, std::size_t bearing,
                       const std::vector<std::vector<int>>& sets, const CommonOptions& common);

/// Every set of lost coils of a bearing with this many, but the empty one; small ones first.
std::vector<std::vector<int>> FailureSetsOf(int coils);

}  // namespace ambrig
