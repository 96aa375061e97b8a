#pragma once
/// The redistribution problem of a bearing of this rig, nominal values, and where its table is
/// kept.
#include <string>

#include "faulttolerance/redistribution/redistribution_table.h"
#include "rig/nominal_rig.h"

namespace ambrig {

RedistributionProblem RedistributionProblemOf(const NominalRig& rig,
                                              const BearingParameters& bearing);

/// $AMBRIG_CACHE, else $XDG_CACHE_HOME/ambrig, else ~/.cache/ambrig; empty when none can be had.
std::string RedistributionCacheDirectory();

}  // namespace ambrig
