#include "fdd/measurement/position_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ambrig {

namespace {
constexpr int kEqualReadings = 6, kDifferentReadings = 50;
// of a departure y - 3 y1 + 3 y2 - y3, over that of a reading
const double kNoise = 6 * std::sqrt(20.0);
}  // namespace

PositionMonitor::PositionMonitor(std::size_t axes, double jump, double noise)
    : axes_(axes), jump_(jump), noise_(kNoise * noise) {}

bool PositionMonitor::Read(double t, const std::vector<double>& readings,
                           const std::vector<double>& struck) {
  if (t <= last_ && count_ > 0) return false;
  step_ = t - last_;
  last_ = t;
  ++count_;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    Axis& a = axes_[k];
    const double y = readings[k];
    if (count_ > 1) {
      a.equal = y == a.y[0] ? a.equal + 1 : 0;
      if (a.equal == 0) ++a.different;
    }
    const double predicted = 3 * a.y[0] - 3 * a.y[1] + a.y[2];
    const double departure = count_ > 4 ? std::abs(y - predicted) : 0;
    const bool jumped = departure > jump_ + (struck.empty() ? 0 : struck[k]);
    a.departure[2] = a.departure[1];
    a.departure[1] = a.departure[0];
    a.departure[0] = std::max(0.0, departure - noise_);
    const bool held = a.different > kDifferentReadings && a.equal >= kEqualReadings;
    if (!a.faulty && (jumped || held)) {
      a.faulty = true;
      new_faults_.push_back(static_cast<int>(k));
    }
    a.y[2] = a.y[1];
    a.y[1] = a.y[0];
    a.y[0] = y;
    const bool parabola = count_ >= 3 && step_ > 0;
    a.slope = parabola ? 1.5 * a.y[0] - 2 * a.y[1] + 0.5 * a.y[2] : 0;
    a.curvature = parabola ? 0.5 * a.y[0] - a.y[1] + 0.5 * a.y[2] : 0;
  }
  per_step_ = step_ > 0 ? 1 / step_ : 0;
  return true;
}

double PositionMonitor::Departure(std::size_t a) const {
  const double* d = axes_[a].departure;
  return std::max({d[0], d[1], d[2]});
}

std::vector<int> PositionMonitor::TakeNewFaults() { return std::exchange(new_faults_, {}); }

}  // namespace ambrig
