#pragma once
/// Words for what is left: block, plane and axis, frequencies or orders, size, what it depends on;
/// and the record that would tell two fitted models apart, found by simulation.
#include <string>

#include "discovery/decision/explanation.h"

namespace ambrig {

Unexplained Describe(const CaseModel& model, const FitResult& fit);

/// Runs both models through feasible scenarios of this rig and names the one whose outputs differ
/// most over the noise.
std::string SeparatingRecord(const CaseModel& model, const Hypothesis& first,
                             const Hypothesis& second);

}  // namespace ambrig
