#pragma once
/// Groups of nuisances (nuisances.h).
#include <string>

namespace ambrig {

/// From record to record: zeros inside the control loop or of the logger, its drift, the clock, the
/// size of the commanded signals. In all records: errors of single coils, of the current sensor's
/// gain and of the bridge's edges. Tables are sorted in this order.
enum class NuisanceGroup {
  kSensorZero,
  kLoggerZero,
  kDrift,
  kTimeShift,
  kInputGain,
  kCurrentGain,
  kEdge
};

/// "sensor zero", "logger zero", "drift", "time shift", "input gain", "current gain", "edge".
std::string ToText(NuisanceGroup group);

}  // namespace ambrig
