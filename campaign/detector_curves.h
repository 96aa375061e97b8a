#pragma once
/// What a study's rows say of each detector at every threshold: false alarms of healthy coils,
/// detections, delays. Thresholds are the levels of fdd/detectors/statistic_level.h.
#include <string>
#include <vector>

#include "campaign/detector_study.h"

namespace ambrig {

/// Per level; a fault counts as detected when the faulty coil's own statistic got there in its
/// window.
struct FaultCurve {
  std::string kind;
  long runs = 0;
  std::vector<double> detected;  // share of the runs
  // delay of half and of 95 % of the runs, inf when fewer were detected [s]
  std::vector<double> median, late;
  // share in which the bearing's first alarm is the faulty coil's
  std::vector<double> named;
  /// Mean of `detected` over log10 of the false-alarm share, from one window (at least 1e-4) to
  /// all: 1 is a detector without errors, a blind one has 0.1.
  double area = 0;
};

struct FalseAlarmCurve {
  std::string scenario;
  long windows = 0;           // of single coils
  std::vector<double> share;  // of the windows that reach the level
  // healthy plants of a study over plants, and how many of them reach the level in some window
  std::size_t plants = 0;
  std::vector<std::size_t> alarmed;
};

struct DetectorCurves {
  std::string name, unit, doc;
  double documented = kRequired;  // threshold of its source, nan: none
  FalseAlarmCurve all;
  std::vector<FalseAlarmCurve> scenarios;
  std::vector<FaultCurve> faults;
  int budget_level = 0;  // lowest level within the study's budget of false alarms
  double score = 0;      // mean detected share over the kinds at that level
  // mean of the delays there, a missed fault counting as the window [s]
  double mean_delay = 0;
};

/// In the study's order of detectors; kinds and scenarios in the order of the rows.
std::vector<DetectorCurves> CurvesOf(const DetectorStudy& study, const Rows& rows);
/// Indices, best first: by score, then by mean delay.
std::vector<std::size_t> Ranking(const std::vector<DetectorCurves>& curves);

}  // namespace ambrig
