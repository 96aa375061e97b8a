#pragma once
/// NAME.commissioning.toml: what `ambrig commission` learnt of a healthy rig, and on which rig.
#include "fdd/learning/commissioned_model.h"
#include "rig/rig_parameters.h"

namespace ambrig {

/// Of everything nominal that a detector knows: amplifier, stators, sensors' places. The plant's
/// true values and effects do not count; nor does what a rig file says of its detection.
std::string ContentHashOf(const RigParameters& nominal);

std::string CommissioningText(const CommissionedModel& model);

/// @throws InputError file:line for every mistake; `learnt_on`: content hash that the file must
/// have been learnt on, empty: any.
CommissionedModel ReadCommissioning(const std::string& file, const std::string& learnt_on);

}  // namespace ambrig
