#pragma once
/// What fault detection tells the rest of the controller.
#include <string>

namespace ambrig {

enum class FaultClass {
  kNone,
  kOpen,
  kPartialShort,
  kAmplifierOff,
  kSwitchStuckOn,
  kCurrentSensor,
  kPositionSensor,
  kBusSag,
};

/// The word of scenario files and reports: "open", "partial-short", ...
inline const char* ToText(FaultClass c) {
  switch (c) {
    case FaultClass::kNone:
      return "";
    case FaultClass::kOpen:
      return "open";
    case FaultClass::kPartialShort:
      return "partial-short";
    case FaultClass::kAmplifierOff:
      return "amplifier-off";
    case FaultClass::kSwitchStuckOn:
      return "switch-stuck-on";
    case FaultClass::kCurrentSensor:
      return "current-sensor";
    case FaultClass::kPositionSensor:
      return "position-sensor";
    case FaultClass::kBusSag:
      return "bus-sag";
  }
  return "";
}

struct Diagnosis {
  int coil = -1;  // from 0
  FaultClass cls = FaultClass::kNone;
  double fraction = 0;    // of shorted turns, partial-short only
  double time = 0;        // of the decision [s]
  double onset = 0;       // start of the first period that looks faulty [s]
  double confidence = 0;  // probability of the class against the next best, 0..1
  // of the turns as the slopes of the ripple see it, partial-short only: larger than `fraction`
  // where turns close through a resistance (fdd/examination/flux_step.h); 0: as `fraction`
  double ripple_fraction = 0;
  double excess = 0;  // of its linkage (fdd/circuit/slope_excess.h), 0: not known [-]
};

}  // namespace ambrig
