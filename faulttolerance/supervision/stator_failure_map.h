#pragma once
/// The map of any stator that runs go to when coils are lost.
#include <string>

#include "control/current/current_map.h"
#include "faulttolerance/redistribution/stator_distribution.h"

namespace ambrig {

/// The problem of a stator whose healthy map is `healthy`, with these shares of its coils'
/// turns, which has to give `load` [N] at rest.
StatorProblem StatorProblemOf(std::shared_ptr<const PoleNetwork> network, int axes,
                              const CurrentMap& healthy, const CoilVector& turns_left,
                              const Eigen::Vector2d& load);

/// Puts the map for the problem's turns in the place of `map`, which is the healthy
/// one. Returns its class for the record: "exact", "linearised", "linearised about the load",
/// "none" (then the rows of lost coils are zero).
std::string StatorMapAfterFailure(const StatorProblem& problem, bool stiffness_compensation,
                                  CurrentMap* map);

}  // namespace ambrig
