#pragma once
/// What the controller measures in one switching period: all that controllers, detectors and the
/// supervisor are given of the plant.
#include <vector>

#include "actuators/magnetics/lane.h"

namespace ambrig {

/// What was measured of one bearing over one switching period.
struct BearingMeasurement {
  const Lane* adc = nullptr;   // samples k = 0..n-1 [A]
  const Lane* duty = nullptr;  // that was applied [-]
  double bus = 0;              // measured supply [V]
  /// Whether its set-points come from its current map; false: its controller
  /// commands currents itself.
  bool mapped = true;
};

struct PeriodMeasurement {
  long long period = 0;  // n; t_n = n T
  double t = 0;          // t_n [s]
  int samples = 0;
  std::vector<BearingMeasurement> bearings;
  const std::vector<double>* readings = nullptr;  // last noisy position readings per axis [m]
  double reading_time = 0;                        // [s]
  double speed = 0;                               // reading of the speed sensor [rad/s]
  double angle = 0;                               // of the shaft at reading_time [rad]
  bool position_loop = true;                      // false: clamped, set-points come from outside
};

}  // namespace ambrig
