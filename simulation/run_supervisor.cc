#include "simulation/run_supervisor.h"

#include "faulttolerance/redistribution/redistribution_setup.h"

namespace ambrig {

std::unique_ptr<FaultSupervisor> SupervisorOf(const RigParameters& rig, const Scenario& scenario,
                                              bool traces) {
  const bool bridges = rig.amplifier.modulation == Modulation::kBiState;
  if (!scenario.fault_tolerant || scenario.start == StartState::kClamped || !bridges)
    return nullptr;
  FaultSupervisorOptions watch;
  watch.slopes = traces;
  watch.redistribution = scenario.redistribution;
  watch.current_transition = scenario.current_transition;
  // A controller that is designed for the stiffness that is left needs nothing made up.
  watch.stiffness_compensation =
      scenario.stiffness_compensation && scenario.retuned_controller.empty();
  watch.cache_dir = RedistributionCacheDirectory();
  return std::make_unique<FaultSupervisor>(NominalRig(rig), watch);
}

}  // namespace ambrig
