#pragma once
/// One run of the rig: NAME.toml. Source: docs/guide/files.md.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "faulttolerance/supervision/current_transition_policy.h"
#include "rig/parameters/rig_parameters.h"
#include "rotor/motion/speed_profile.h"
#include "scenarios/excitation.h"
#include "scenarios/faults/fault_spec.h"

namespace ambrig {

struct LoadSpec {
  double z = 0;
  bool axial = false;
  double fx = 0, fy = 0, fz = 0;
  double start = 0, stop = 0;
};

/// From the first controller tick at or after `time` on, another controller of the rig is in
/// charge.
struct SwitchSpec {
  double time = 0;  // [s]
  std::string to;   // "main" or a name of [controllers]
};

enum class StartState { kLevitated, kResting, kClamped };

/// What makes a scenario a regression test; absent keys are not checked.
struct Expectation {
  std::optional<double> detected_within;  // [s]
  std::optional<std::string> classified;
  std::optional<bool> touchdown, drop, redistributed;
  std::optional<double> max_orbit;         // [m]
  std::optional<double> max_false_alarms;  // [-]
  std::optional<double> rests_within;      // [m], orbit over the last tenth of the run
  bool any() const {
    return detected_within || classified || touchdown || drop || redistributed || max_orbit ||
           max_false_alarms || rests_within;
  }
  /// The first key that only a run with fault detection can meet; empty: none.
  std::string_view NeedsDetection() const {
    if (detected_within) return "detected_within";
    if (classified) return "classified";
    return redistributed.value_or(false) ? "redistributed" : "";
  }
};

struct Scenario {
  std::string name, file, rig_file;
  double duration = 0, record_rate = 0;
  std::uint64_t seed = 1;
  bool noise = true;
  bool fault_tolerant = true;           // detection and redistribution act
  std::string redistribution = "auto";  // auto, matrix, force-by-force (fault_supervisor.h)
  std::string current_transition =
      kDefaultCurrentTransition;       // faulttolerance/supervision/current_transition_policy.h
  bool stiffness_compensation = true;  // of a failed bearing's other negative stiffness
  std::string retuned_controller;      // designed again after a redistribution; empty: none
  StartState start = StartState::kLevitated;
  std::map<std::string, std::array<double, 2>> clamp;
  std::map<std::string, double> start_current;  // of a clamped start: by coil, "A.coil1" [A]
  SpeedProfile speed;
  double speed_free_from = kInfinity;
  std::vector<Excitation> excitations;
  std::vector<LoadSpec> loads;
  std::vector<FaultSpec> faults;
  std::vector<SwitchSpec> switches;
  double drop_limit = 0.1;  // [s] longest contact that is not yet a drop
  Expectation expect;
};

/// @throws InputError with file:line. The rig is needed to check targets.
Scenario ReadScenario(const std::string& file, const RigParameters& rig);
Scenario ReadScenarioText(const std::string& text, const std::string& file,
                          const RigParameters& rig);
/// Rig file that a scenario names, as a path relative to the working directory.
std::string RigOfScenario(const std::string& file);
bool HasExpectations(const std::string& file);

}  // namespace ambrig
