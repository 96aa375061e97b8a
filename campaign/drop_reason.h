#pragma once
/// Why the rotor of a run touched down or dropped, told from what the machine could do and from
/// what fault tolerance did until the first contact. The first that holds:
///
///   bounced before         it touched before the first fault
///   load not carried       the coils left at the contact do not pull the load, margin < 1
///   fault not detected     a fault before the contact was not found until then
///   healthy coil given up  an action on a coil without a fault, before the contact
///   little margin          1 <= margin < 1.3
///   transition             carried at rest, with all faults found: delay, slew or voltage
#include <string>

#include "campaign/run_plan.h"
#include "simulation/record/run_result.h"

namespace ambrig {

/// Margin of the load from which on a set is expected to hold its rotor.
inline constexpr double kMarginOfSurvival = 1.3;

/// Empty for a run that stayed up, without faults, or of coils that no map is made for.
std::string DropReason(const RunPlan& plan, const PlannedRun& p, const RunResult& r);

/// An action of fault tolerance on a coil that had no fault at that time.
bool IsFalseAction(const Scenario& scenario, const CoilAction& action);

}  // namespace ambrig
