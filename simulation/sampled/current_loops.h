#pragma once
/// The current loops of all coils at the start of a switching period, the same in every fidelity:
/// set-points and what the scenario adds to them become duties. Source: docs/theory/base_model.md
/// section 3.
#include "control/current/bearing_control.h"
#include "rig/nominal_rig.h"
#include "simulation/sampled/command_plan.h"

namespace ambrig {

class CurrentLoops {
 public:
  enum class SetPoints {
    kOfTheController,  // position loop; nothing of the scenario before t = 0
    kOfTheScenario,    // clamped rotor: the scenario's currents alone, before t = 0 as at t = 0
    kMeasured,         // `commanded` follows data; the scenario's currents come on top
    kMeasuredWhole,    // the data hold them already
  };

  /// `commands` must outlive the loops.
  CurrentLoops(const NominalRig& nominal, const CommandPlan& commands)
      : duty_min_(nominal->amplifier.duty_min), commands_(commands) {}

  void Follow(SetPoints source) { source_ = source; }
  /// The first period after everything was switched on: no feedback yet, least duty.
  void SwitchOn() { first_period_ = true; }
  /// Duties of period n from the feedback of the one before it.
  void Period(long long n, std::vector<BearingControl>& control);

 private:
  /// The period whose commands of the scenario act in period n; negative: none do.
  long long CommandsOf(long long n) const;
  void Targets(long long n, std::vector<BearingControl>& control);

  double duty_min_;  // [-]
  const CommandPlan& commands_;
  SetPoints source_ = SetPoints::kOfTheController;
  bool first_period_ = false;
  std::vector<Lane> target_;  // kept: no allocation in the loop
};

}  // namespace ambrig
