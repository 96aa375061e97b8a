#pragma once
/// What the last round of a search says once the search has ended.
#include <string>
#include <vector>

#include "discovery/decision/explanation.h"

namespace ambrig {

/// Of a concluded explanation: notes the effects beside which the last round was ranked
/// (`second_beside`), and gives its members probabilities [-] that agree with the sets: those
/// beside the other effects where one of them was adopted, else 0. `own`: effects of the rig file.
void SettleSecondRound(std::size_t own, Explanation& out);

/// Whether one of the last round was adopted.
bool SecondRoundAdopted(const Explanation& e);

/// "candidates beside a at A: none of them was adopted"
std::string SecondRoundTitle(const Explanation& e);

}  // namespace ambrig
