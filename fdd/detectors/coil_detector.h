#pragma once
/// One interface for all detectors of coil faults: what the controller measured of a bearing in one
/// switching period goes in, a scalar statistic of every coil comes out. A fault is flagged where
/// the statistic exceeds a threshold, so that thresholds can be swept over stored statistics.
#include <memory>
#include <span>
#include <string_view>

#include "fdd/detectors/run_detector.h"

namespace ambrig {

class CoilDetector {
 public:
  virtual ~CoilDetector() = default;
  /// Statistic of every coil after this period, zero or more, never nan; unit: that of its kind.
  virtual Lane Period(const MeasuredPeriod& in) = 0;
};

/// A kind of detector: each one's file has a function that returns it, and detector_catalogue.cc
/// has one line with the function's name.
struct CoilDetectorKind {
  std::string_view name, unit, doc;
  double threshold;  // that its source or its code uses; nan: none
  /// Of its statistic in a run where the rig file names none: the lowest one with at most 1e-4
  /// false alarms per coil and 10 ms in scenarios/studies/detectors.toml (docs/guide/detectors.md).
  double run_threshold;
  /// Its statistic, for studies and for runs; nullptr: it has none.
  std::unique_ptr<CoilDetector> (*make)(const CoilDetectorSetup& setup);
  /// Of a detector that classifies by itself; nullptr: its alarms are examined
  /// (examined_detector.h).
  std::unique_ptr<RunDetector> (*make_run)(const RunDetectorSetup& setup) = nullptr;
};

/// Maker of a kind that needs nothing but the setup.
template <class Detector>
std::unique_ptr<CoilDetector> MakeDetector(const CoilDetectorSetup& setup) {
  return std::make_unique<Detector>(setup);
}

/// All of them, see detector_catalogue.cc.
std::span<const CoilDetectorKind> CoilDetectorKinds();

}  // namespace ambrig
