#pragma once
/// The position controller fed with what a record holds: measured readings and the scenario's
/// commands in, set-points out. Both sides were computed by one program, so that they agree to the
/// rounding of the record whatever the plant does: an error here is one of the record, of its
/// scenario or of the controller that the rig file states, and of no physical effect.
#include <string>
#include <vector>

#include "core/record/missing_samples.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// One axis of the controller beside the set-points of the record. Values are control currents [A]:
/// the projection of the bearing's set-points on the axis; row k stands for the set-points of row
/// k + 1, computed from the readings of row k.
struct ControllerAxis {
  std::string axis;              // "A.x"
  std::vector<double> measured;  // [A]
  std::vector<double> error;     // measured less computed, about its mean [A]
  std::vector<char> counts;      // 0: while the derivative settles, at gaps and at limits
  double rms = 0;                // of the error [A]
  double movement = 0;           // rms of the measured about its mean [A]

  /// The change of the axis' reference [m] that explains the error: the PID run backwards.
  std::vector<double> reference;
};

/// Whether a record can be compared so: plain PID, not held, rows at the rate of the controller.
bool HasControllerBlock(const RigParameters& nominal, const Scenario& scenario, const Record& data);

/// Every axis of eight-pole bearings whose readings and set-points the record holds. The integral's
/// start is unknown and is taken from the first set-points. `late` [rows]: the commands act so
/// much later.
std::vector<ControllerAxis> ControllerAxes(const RigParameters& nominal, const Scenario& scenario,
                                           const BridgedRecord& data, double late = 0);

}  // namespace ambrig
