#pragma once
/// What a rig file and a scenario may ask of a bearing with any stator, whose map is linearised and
/// whose detector is its own.
#include <string>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// @throws InputError for a redistribution or a [detection] kind that such a bearing does not have:
/// it would change nothing, unseen.
void CheckWhatStatorsAllow(const RigParameters& rig, const BearingParameters& b,
                           const std::string& redistribution);

}  // namespace ambrig
