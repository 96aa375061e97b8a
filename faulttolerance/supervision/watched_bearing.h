#pragma once
/// What the supervisor holds of one bearing.
#include <memory>
#include <optional>

#include "faulttolerance/supervision/coil_probes.h"
#include "faulttolerance/supervision/fault_supervisor.h"

namespace ambrig {

struct FaultSupervisor::Watched {
  const BearingParameters* bearing = nullptr;
  std::size_t index = 0;
  std::unique_ptr<RunDetector> detector;
  std::unique_ptr<RedistributionTable> table;
  CoilVector turns_left = CoilVector::Ones();
  std::optional<CurrentMap> healthy;  // the map before the first action
  double bias = 0;                    // of a coil [A]
  bool mapped = true;                 // its set-points come from its map (control/measurements.h)
  CoilProbes probes;
  int probed = -1;        // coil that a current is asked of now
  bool doubted = false;   // whether the detector doubted its model when that began
  int alarmed = -1;       // coil that the alarm was raised for
  bool doubtful = false;  // its detector has doubted its model in this run
  double periods = 0, doubtful_periods = 0;  // watched; with the detector in doubt
};

}  // namespace ambrig
