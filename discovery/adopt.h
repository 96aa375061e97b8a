#pragma once
/// Writes a new rig file with an effect and its fitted parameters, and what the calibration found of
/// the toleranced ones (`fitted` beside `value`: the controller keeps the drawing's numbers).
#include <string>
#include <vector>

#include "discovery/fit.h"

namespace ambrig {

/// TOML of the rig file `text` with `fitted` values put into its { value, sd } numbers and the
/// effects appended. Comments and layout of the file stay.
std::string AdoptedRigText(const std::string& text, const Hypothesis& h, const std::vector<EffectInstance>& effects);

}  // namespace ambrig
