#pragma once
/// Set-points that a logger clipped or held. The controller itself holds them at its coils' limits
/// and, those of one axis together, where its force is at a limit.
#include <vector>

#include "discovery/data/held_values.h"
#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

/// Floors by which a prediction passes a value to be beyond it.
inline constexpr double kBeyondFloors = 5;

/// Rows of a set-point at its own extreme, where that is none of its coil's limits and the other
/// set-points of its bearing are not at theirs, as a force at its limit holds them. A controller's
/// numbers repeat no other value a tenth as often.
std::size_t ClippedSetPointRows(const CaseModel& model, const CaseRecord& r, const GateColumn& c,
                                const std::vector<double>& y, double extreme);

/// Whether a set-point stands although neither its coil nor a force is at a limit.
bool SetPointFroze(const CaseRecord& r, const GateColumn& c, const HeldStretch& s);

}  // namespace ambrig
