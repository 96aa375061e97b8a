#include "simulation/run_supervisor.h"

#include "faulttolerance/redistribution/redistribution_setup.h"
#include "scenarios/expect_file.h"
#include "simulation/commissioning/other_machine.h"

namespace ambrig {

RunSupervisor SupervisorOf(const RigParameters& rig, const Scenario& scenario, bool traces) {
  if (!scenario.fault_tolerant || !WhyUnwatched(rig, scenario).empty()) return {};
  FaultSupervisorOptions watch;
  watch.slopes = traces;
  watch.redistribution = scenario.redistribution;
  watch.current_transition = scenario.current_transition;
  // A controller that is designed for the stiffness that is left needs nothing made up.
  watch.stiffness_compensation =
      scenario.stiffness_compensation && scenario.retuned_controller.empty();
  watch.cache_dir = RedistributionCacheDirectory();
  RigParameters watched = rig;
  std::string note = OtherMachineNote(rig);
  if (!note.empty()) watched.detection.commissioning = "none";
  return {std::make_unique<FaultSupervisor>(NominalRig(watched), watch), std::move(note)};
}

}  // namespace ambrig
