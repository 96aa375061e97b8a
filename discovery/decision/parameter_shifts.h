#pragma once
/// How far a fit moved the numbers of the drawing.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// "bearings.A.gap +1.20 sd" of every rig parameter that the hypothesis has by more than `least` of
/// its sd [-] from where the rig file has it. `looser`: the sd of the hypothesis over that of the
/// rig file, in whose sd the shifts are told.
std::vector<std::string> ParameterShifts(const Hypothesis& h, double least, double looser = 1);

}  // namespace ambrig
