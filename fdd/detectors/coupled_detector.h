#pragma once
/// The watching half of the coupled detector (bearing_detector.h), learned leakage and gap
/// included, as a statistic: the largest of a coil's three sums G. The detector itself alarms at G
/// > 9.
#include "fdd/detectors/bearing_detector.h"
#include "fdd/detectors/coil_detector.h"

namespace ambrig {

class CoupledDetector : public CoilDetector {
 public:
  explicit CoupledDetector(const CoilDetectorSetup& setup);
  Lane Period(const MeasuredPeriod& in) override;

 private:
  BearingDetector watch_;
};

}  // namespace ambrig
