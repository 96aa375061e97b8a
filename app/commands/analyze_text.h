#pragma once
/// The text of `ambrig analyze` of a rig.
#include "analysis/rig_analysis.h"

namespace ambrig {

/// On the standard output.
void PrintAnalysis(const RigAnalysis& analysis);

}  // namespace ambrig
