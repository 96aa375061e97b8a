#pragma once
/// Seam between the engine and what watches it in the controller: fault detection and
/// redistribution. It sees what a real controller sees, never the plant.
#include <vector>

#include "control/current/bearing_control.h"
#include "control/measurements.h"
#include "simulation/record/run_result.h"

namespace ambrig {

class Supervisor {
 public:
  virtual ~Supervisor() = default;
  /// After period n is measured; may change maps, integrals, `disabled`, and add events.
  virtual void AfterPeriod(const PeriodMeasurement& m, std::vector<BearingControl>& control,
                           std::vector<RunEvent>& events) = 0;
  virtual void Finish(RunResult&) {}
};

}  // namespace ambrig
