#pragma once
/// What a kind of fault is: one file per kind beside this one, one line each in catalogue.cc. The
/// readers of scenarios and campaigns, `ambrig parameters`, the engines of every fidelity, the
/// score of detection and the plan of a campaign all walk the catalogue; none of them knows a kind
/// by its name.
#include <span>
#include <string_view>

#include "rig/parameters/rig_parameters.h"
#include "scenarios/faults/fault_spec.h"

namespace ambrig {

class FaultedPlant;

/// What [[fault]] target names: "A.coil3", "A.x", "rig".
enum class FaultTarget { kCoil, kAxis, kRig };

/// What in the controller may see the fault.
enum class FaultObserver { kNobody, kCoilDetector, kPositionMonitor, kBusMonitor };

/// One number or switch of a kind.
struct FaultParameter {
  std::string_view key, unit;
  double lo, hi;
  bool ends_allowed;  // the bounds themselves
  bool flag;          // true or false in files, 1 or 0 here
  std::string_view doc;
  double neutral = 0;  // the value that changes nothing
  bool required = false;
  /// The rig's own number, in the same unit, that it must stay below: a sag is no rise.
  double AmplifierParameters::*below = nullptr;
};

struct Fault {
  std::string_view kind;  // as files write it
  FaultTarget target;
  std::string_view doc;
  FaultObserver observer;
  /// Class that the observer should give it, one of fdd/diagnosis.h; empty where nobody sees it.
  std::string_view seen_as;
  std::span<const FaultParameter> parameters = {};
  /// A file whose parameters are all neutral is refused.
  bool must_change = false;
  /// What happens to the plant, at once (faulted_plant.h).
  void (*apply)(const FaultSpec& fault, FaultedPlant& plant);
  /// Of a fault that ends: after how long [s], and what happens then. A later fault of the same
  /// kind and target takes the place of an end that is still to come.
  double (*duration)(const FaultSpec& fault) = nullptr;
  void (*end)(FaultedPlant& plant) = nullptr;
  /// Whether it closes a winding of its own on the coil's pole, whose current is one more state of
  /// the bearing's circuit; nullptr: never.
  bool (*adds_winding)(const FaultSpec& fault) = nullptr;
  /// Share of a coil's turns that the controller can use once it knows the fault; nullptr: none.
  double (*turns_left)(const FaultSpec& fault) = nullptr;
};

/// All kinds, see catalogue.cc.
std::span<const Fault* const> Faults();
/// @throws std::logic_error for a name that is not in the catalogue.
const Fault& FaultByKind(std::string_view kind);

}  // namespace ambrig
