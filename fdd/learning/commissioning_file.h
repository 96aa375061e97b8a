#pragma once
/// NAME.commissioning.toml: what `ambrig commission` learnt of a healthy rig, and on which rig.
#include "fdd/learning/commissioned_model.h"

namespace ambrig {

/// Of everything nominal that a detector knows of a bearing: its amplifier and its stator. The
/// plant's true values and effects do not count, nor does what a rig file says of its detection.
std::string ContentHashOf(const LinkageModel& nominal, const AmplifierParameters& amplifier);

std::string CommissioningText(const CommissionedModel& model);

/// @throws InputError file:line for every mistake.
CommissionedModel ReadCommissioning(const std::string& file);

/// rig.toml -> rig.commissioning.toml, beside it: what `ambrig commission` writes and what a run
/// finds by itself.
std::string CommissioningFileOf(const std::string& rig_file);

/// The bearing `name` of a file, nominal when the file's name is empty or the file has no such
/// bearing. @throws InputError also when it was learnt on another bearing.
CommissionedBearing ReadCommissionedBearing(const std::string& file, const std::string& name,
                                            const LinkageModel& nominal,
                                            const AmplifierParameters& amplifier);

/// Whether the file is there, has the bearing, and learnt it with these nominal values.
/// @throws InputError for a file that cannot be read as one.
bool FitsBearing(const std::string& file, const std::string& name, const LinkageModel& nominal,
                 const AmplifierParameters& amplifier);

}  // namespace ambrig
