#pragma once
/// How far a fit moved the numbers of the drawing.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// "bearings.A.gap +1.20 sd" of every rig parameter that the hypothesis has by more than `least` of
/// its sd [-] from where the rig file has it.
std::vector<std::string> ParameterShifts(const Hypothesis& h, double least);

}  // namespace ambrig
