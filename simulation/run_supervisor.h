#pragma once
/// The supervisor that a scenario asks for: fault tolerance of a levitated run.
#include <memory>
#include <string>

#include "faulttolerance/supervision/fault_supervisor.h"
#include "scenarios/scenario.h"

namespace ambrig {

struct RunSupervisor {
  std::unique_ptr<FaultSupervisor> supervisor;  // null where the scenario or the rig has none
  std::string other_machine;  // that its commissioning is not used (OtherMachineNote); empty: it is
};

/// Null where the scenario or the rig has none (scenarios/expect_file.h). `traces`: slopes round
/// the first alarm are kept.
RunSupervisor SupervisorOf(const RigParameters& rig, const Scenario& scenario, bool traces);

}  // namespace ambrig
