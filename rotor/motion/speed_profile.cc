#include "rotor/motion/speed_profile.h"

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"

namespace ambrig {

SpeedProfile::SpeedProfile(const std::vector<std::vector<double>>& rows) {
  Require(!rows.empty(), "a speed profile with at least one row");
  for (const auto& row : rows) {
    t_.push_back(row[0]);
    w_.push_back(row[1]);
  }
  for (std::size_t k = 0; k + 1 < t_.size(); ++k)
    acceleration_.push_back((w_[k + 1] - w_[k]) / (t_[k + 1] - t_[k]));
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

SpinState SpeedProfile::At(double t) const {
  if (t < t_.front()) return {angle_.front() + w_.front() * (t - t_.front()), w_.front(), 0};
  const std::size_t k = Segment(t);
  const double since = t - t_[k];
  if (k + 1 == t_.size()) return {angle_[k] + 0.5 * (w_[k] + w_[k]) * since, w_[k], 0};
  const double acceleration = acceleration_[k], speed = w_[k] + acceleration * since;
  return {angle_[k] + 0.5 * (w_[k] + speed) * since, speed, acceleration};
}

double SpeedProfile::LargestSpeed(double duration) const {
  double most = std::max(std::abs(Speed(0)), std::abs(Speed(duration)));
  for (std::size_t k = 0; k < t_.size(); ++k)
    if (t_[k] > 0 && t_[k] < duration) most = std::max(most, std::abs(w_[k]));
  return most;
}

double SpeedProfile::Acceleration(double t) const { return At(t).acceleration; }

double SpeedProfile::Speed(double t) const { return At(t).speed; }

double SpeedProfile::Angle(double t) const { return At(t).angle; }

}  // namespace ambrig
