#pragma once
/// What a run gives back: the record, what happened when, and the figures of the verdict.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/record/record.h"
#include "core/record/run_event.h"
#include "faulttolerance/supervision/supervisor.h"

namespace ambrig {

struct RunMetrics {
  std::map<std::string, double> max_orbit;  // per bearing, from t = 0 [m]
  double min_clearance_left = 0;            // [m], negative: penetration
  double peak_current = 0;                  // [A]
  double copper_loss = 0;                   // mean over the run [W]
  double detection_delay = -1;              // worst over the faults [s], -1: none
  double redistribution_delay = -1;         // from the fault [s]
  double false_alarms = 0;
  double coil_periods = 0;  // healthy coil-periods watched
  double real_time_factor = 0;
  double settled_orbit = 0;    // largest orbit of the last tenth of the run [m]
  double longest_contact = 0;  // [s]
};

/// Fluxes and shaft position of one bearing at an instant, for the report's drawing. The flux of
/// a coil is that of its pole; of one that links several poles, their mean by its turns.
struct FluxSnapshot {
  double t = 0;
  std::string bearing, label;
  std::vector<double> flux, current;  // per coil [Wb], [A]
  double x = 0, y = 0;                // [m]
};

struct RunResult {
  Record record;
  std::vector<RunEvent> events;
  RunMetrics metrics;
  bool touchdown = false, drop = false;
  std::vector<FluxSnapshot> snapshots;
  std::vector<SlopeTrace> slopes;
  std::vector<CoilAction> actions;               // of fault tolerance
  bool doubtful = false;                         // a detector doubted its model during the run
  std::map<std::string, double> doubtful_share;  // per bearing, of the periods watched
  bool interfered = false;  // fault tolerance sent an action; if not, the run is the one without it
  std::vector<std::string> notes;
};

/// What the supervisor has to tell when the run is over; null: nothing.
void AddSummary(const Supervisor* supervisor, RunResult& result);

}  // namespace ambrig
