#pragma once
/// Several detectors of coil faults on one run, all fed with what the controller measured; none of
/// them acts on the run. What is kept of a statistic allows any threshold to be asked for
/// afterwards.
///
/// A healthy run is cut into windows: of every coil and window the largest statistic is counted (a
/// false alarm is a window whose largest statistic exceeds the threshold). Of a run with a fault:
/// when, within one window from the fault on, each level was first reached, by the faulty coil and
/// by any coil of its bearing.
#include <map>
#include <memory>
#include <vector>

#include "faulttolerance/supervision/supervisor.h"
#include "fdd/detectors/coil_detector.h"
#include "fdd/detectors/detection_feed.h"
#include "fdd/detectors/statistic_level.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// A new largest level.
struct LevelReached {
  int period = 0;  // from the one of the fault on
  int level = 0;
  bool right = true;  // the faulty coil has the largest statistic of its bearing
};

struct DetectorOutcome {
  // healthy: level -> windows whose largest statistic lies there
  std::map<int, long> windows;
  std::vector<LevelReached> coil, bearing;  // faulty: of the coil, of the largest of its bearing
};

struct TrialSettings {
  double begin = 0.02;   // [s] detectors start; in a run with a fault: that much before it
  double settle = 0.01;  // [s] from there on nothing is counted
  double window = 0.01;  // [s]
  // of the bearings whose coils count, healthy
  std::vector<const BearingKind*> kinds = {&RadialBearing()};
};

class DetectorTrial : public Supervisor {
 public:
  /// The first fault of the scenario, if any, on one coil.
  DetectorTrial(const NominalRig& nominal, const Scenario& scenario,
                const std::vector<CoilDetectorKind>& kinds, const TrialSettings& settings);
  ~DetectorTrial() override;

  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput& out) override;
  /// One per kind. A fault's window that the run did not reach: throws std::logic_error.
  std::vector<DetectorOutcome> Take();

 private:
  struct OneDetector;
  void CountHealthy(OneDetector& d, const std::vector<Lane>& statistic);
  void CountFaulty(OneDetector& d, const Lane& statistic, int period);

  const NominalRig rig_;
  DetectionFeed feed_;
  std::vector<std::unique_ptr<OneDetector>> detectors_;
  std::vector<bool> watched_;  // per bearing
  bool faulty_ = false;
  std::size_t bearing_ = 0;  // of the fault
  int coil_ = 0;
  long long begin_ = 0, count_from_ = 0, window_ = 1;  // periods
  long long in_window_ = 0, seen_ = 0;
};

}  // namespace ambrig
