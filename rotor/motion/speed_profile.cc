#include "rotor/motion/speed_profile.h"

#include "core/base/errors.h"

namespace ambrig {

SpeedProfile::SpeedProfile(const std::vector<std::vector<double>>& rows) {
  Require(!rows.empty(), "a speed profile with at least one row");
  for (const auto& row : rows) {
    t_.push_back(row[0]);
    w_.push_back(row[1]);
  }
  angle_.assign(t_.size(), 0);
  for (std::size_t k = 1; k < t_.size(); ++k)
    angle_[k] = angle_[k - 1] + 0.5 * (w_[k] + w_[k - 1]) * (t_[k] - t_[k - 1]);
  const double zero = Angle(0);
  for (double& a : angle_) a -= zero;
}

std::size_t SpeedProfile::Segment(double t) const {
  std::size_t k = 0;
  while (k + 1 < t_.size() && t >= t_[k + 1]) ++k;
  return k;
}

double SpeedProfile::Acceleration(double t) const {
  if (t < t_.front() || t >= t_.back()) return 0;
  const std::size_t k = Segment(t);
  return (w_[k + 1] - w_[k]) / (t_[k + 1] - t_[k]);
}

double SpeedProfile::Speed(double t) const {
  if (t <= t_.front()) return w_.front();
  if (t >= t_.back()) return w_.back();
  const std::size_t k = Segment(t);
  return w_[k] + (w_[k + 1] - w_[k]) / (t_[k + 1] - t_[k]) * (t - t_[k]);
}

double SpeedProfile::Angle(double t) const {
  if (t <= t_.front()) return angle_.front() + w_.front() * (t - t_.front());
  const std::size_t k = Segment(t);
  return angle_[k] + 0.5 * (w_[k] + Speed(t)) * (t - t_[k]);
}

}  // namespace ambrig
