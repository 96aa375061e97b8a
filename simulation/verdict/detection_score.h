#pragma once
/// What the alarms of a run are worth, judged with the scenario's faults in hand:
/// delays, classes and false alarms. The one place that compares events of the supervisor with
/// the true faults.
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

struct FaultScore {
  bool of_a_coil = true;                // one that the coils' detector is to find
  bool judged = true;                   // it came before the rotor was lost
  std::optional<double> detected;       // first alarm of the fault's target [s after the fault]
  std::optional<double> redistributed;  // first redistribution of its bearing [s after the fault]
  std::string last_class;               // of the target after the fault; empty: none
  bool right_class = false;  // the last one, as a class may be refined while more is seen
};

struct DetectionScore {
  std::vector<FaultScore> faults;  // as in the scenario
  std::size_t false_alarms = 0;    // alarms of a healthy target, or before its fault

  std::size_t judged() const;
  std::size_t detected() const;
  /// Of those, faults of coils.
  std::size_t judged_coils() const;
  std::size_t redistributed() const;
  std::size_t right_class() const;
  /// Of those that are judged.
  bool a_coil_was_missed() const;
  bool all_detected() const { return detected() == judged(); }
  /// The longest among the faults that were detected, or followed by a
  /// redistribution [s]; -1: none.
  double longest_detection() const;
  double longest_redistribution() const;
};

/// When the rotor was lost: it dropped, or went past the poles, where there is no model. What is
/// said and what fails after that is not judged. [s], infinity: it was not lost.
double LostAt(const std::vector<RunEvent>& events);

/// `events` in order of time.
DetectionScore ScoreDetection(const std::vector<FaultSpec>& faults,
                              const std::vector<RunEvent>& events);

/// Puts delays and false alarms into the metrics of the run; a delay only where every fault that is
/// judged has one.
void ScoreDetection(const Scenario& scenario, RunResult& result);

}  // namespace ambrig
