#pragma once
/// Seam between the engine and what watches a run in the controller: fault detection and
/// redistribution. A supervisor is given what the controller measured and what it commands, both
/// const, and answers with actions and events of its own. It never sees the plant, the scenario's
/// faults or the result of the run.
#include <map>
#include <string>
#include <vector>

#include "control/current/control_action.h"
#include "control/measurements.h"
#include "core/record/run_event.h"

namespace ambrig {

/// The answer to one switching period. The engine clears it, and applies the actions
/// in their order.
struct SupervisorOutput {
  std::vector<ControlAction> actions;
  std::vector<RunEvent> events;  // alarms and what follows from them
};

/// Slope of one coil against what the detector expects, one row per switching period.
struct SlopeTrace {
  std::string coil;
  std::vector<double> t, slope, low, high;  // [s], [A/s]
};

/// What fault tolerance did to one coil, and why.
struct CoilAction {
  double t = 0;        // [s]
  std::string coil;    // "A.coil3"
  std::string action;  // disable | restore | probe | derate: fewer turns are counted on
  std::string reason;  // class of the fault, size
};

/// What a supervisor has to tell when a run is over.
struct SupervisorSummary {
  std::vector<CoilAction> actions;
  bool doubtful = false;                         // some detector doubted its model during the run
  std::map<std::string, double> doubtful_share;  // per bearing, of the periods watched
  bool interfered = false;         // sent an action; if not, the run is the one without it
  double coil_periods = 0;         // coils watched, times periods
  std::vector<SlopeTrace> slopes;  // of the first alarm
};

class Supervisor {
 public:
  virtual ~Supervisor() = default;
  /// After switching period m.period is measured. `control`: one entry per bearing, as
  /// it was during the period.
  virtual void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                           SupervisorOutput& out) = 0;
  virtual SupervisorSummary Summary() const { return {}; }
};

}  // namespace ambrig
