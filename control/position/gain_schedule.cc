#include "control/position/gain_schedule.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

ScheduleSpot Locate(const std::vector<double>& speeds, double Omega) {
  const double w = std::abs(Omega);
  if (speeds.size() < 2 || w <= speeds.front()) return {};
  const auto above = std::upper_bound(speeds.begin(), speeds.end(), w);
  if (above == speeds.end()) return {speeds.size() - 2, 1};
  const auto low = static_cast<std::size_t>(above - speeds.begin()) - 1;
  return {low, (w - speeds[low]) / (speeds[low + 1] - speeds[low])};
}

PidParameters PidSchedule::At(double Omega) const {
  if (points.size() == 1) return points.front();
  const ScheduleSpot s = Locate(speeds, Omega);
  PidParameters p = points[s.low];
  for (const Field<PidParameters>& f : kPidFields)
    p.*f.at = (1 - s.weight) * points[s.low].*f.at + s.weight * points[s.low + 1].*f.at;
  return p;
}

}  // namespace ambrig
