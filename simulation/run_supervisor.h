#pragma once
/// The supervisor that a scenario asks for: fault tolerance of a levitated run.
#include <memory>

#include "faulttolerance/supervision/fault_supervisor.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// Null where the scenario or the rig has none (scenarios/expect_file.h). `traces`: slopes round
/// the first alarm are kept.
std::unique_ptr<FaultSupervisor> SupervisorOf(const RigParameters& rig, const Scenario& scenario,
                                              bool traces);

}  // namespace ambrig
