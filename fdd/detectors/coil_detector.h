#pragma once
/// One interface for all detectors of coil faults: what the controller measured of a bearing in one
/// switching period goes in, a scalar statistic of every coil comes out. A fault is flagged where
/// the statistic exceeds a threshold, so that thresholds can be swept over stored statistics.
#include <memory>
#include <span>
#include <string_view>

#include "fdd/detectors/bearing_detector.h"

namespace ambrig {

class CoilDetector {
 public:
  virtual ~CoilDetector() = default;
  /// Statistic of every coil after this period, zero or more, never nan; unit: that of its kind.
  virtual Lane Period(const MeasuredPeriod& in) = 0;
};

/// A bearing as the controller knows it: nominal circuit, sampling, noise and the maker's
/// tolerances.
struct CoilDetectorSetup {
  LinkageModel model;
  DetectorSettings settings;
};

struct CoilDetectorKind {
  std::string_view name, unit, doc;
  double threshold;  // that its source or its code uses; nan: none
  std::unique_ptr<CoilDetector> (*make)(const CoilDetectorSetup& setup);
};

/// All of them, see detector_catalogue.cc.
std::span<const CoilDetectorKind> CoilDetectorKinds();

}  // namespace ambrig
