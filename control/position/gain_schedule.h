#pragma once
/// Gains over the spin speed: linear between the points given, held outside, by |Omega|.
#include <vector>

#include "control/position/pid.h"

namespace ambrig {

/// value = (1 - weight) v[low] + weight v[low + 1]; with one point low = 0, weight = 0.
struct ScheduleSpot {
  std::size_t low = 0;
  double weight = 0;
};
/// `speeds` ascending, at least one [rad/s].
ScheduleSpot Locate(const std::vector<double>& speeds, double Omega);

/// A PID whose gains change with the speed. Its states stay: the integral is in newtons, so nothing
/// jumps.
struct PidSchedule {
  std::vector<double> speeds{0};      // [rad/s]
  std::vector<PidParameters> points;  // one per speed
  PidParameters At(double Omega) const;
};

}  // namespace ambrig
