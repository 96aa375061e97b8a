#include "simulation/run_supervisor.h"

#include "faulttolerance/redistribution/redistribution_setup.h"
#include "scenarios/expect_file.h"
#include "simulation/commissioning/other_machine.h"

namespace ambrig {

std::unique_ptr<FaultSupervisor> SupervisorOf(const RigParameters& rig, const Scenario& scenario,
                                              bool traces) {
  if (!scenario.fault_tolerant || !WhyUnwatched(rig, scenario).empty()) return nullptr;
  FaultSupervisorOptions watch;
  watch.slopes = traces;
  watch.redistribution = scenario.redistribution;
  watch.current_transition = scenario.current_transition;
  // A controller that is designed for the stiffness that is left needs nothing made up.
  watch.stiffness_compensation =
      scenario.stiffness_compensation && scenario.retuned_controller.empty();
  watch.cache_dir = RedistributionCacheDirectory();
  RigParameters watched = rig;
  if (!OtherMachineNote(rig).empty()) watched.detection.commissioning = "none";
  return std::make_unique<FaultSupervisor>(NominalRig(watched), watch);
}

}  // namespace ambrig
