#pragma once
/// Prescribed spin speed: piecewise linear Omega(t), theta(0) = 0; before the first and after the
/// last point the speed is constant. Source: docs/guide/files.md.
#include <vector>

namespace ambrig {

/// The spin at one instant.
struct SpinState {
  double angle = 0, speed = 0, acceleration = 0;  // [rad], [rad/s], [rad/s2]
};

class SpeedProfile {
 public:
  SpeedProfile() : SpeedProfile({{0.0, 0.0}}) {}
  /// Rows (t [s], Omega [rad/s]) with increasing t. A step is written as two rows 1 us apart.
  explicit SpeedProfile(const std::vector<std::vector<double>>& rows);
  double Speed(double t) const;         // [rad/s]
  double Angle(double t) const;         // [rad], unwrapped, 0 at t = 0
  double Acceleration(double t) const;  // [rad/s2]
  /// All three at once.
  SpinState At(double t) const;
  /// The largest |Omega| from t = 0 to `duration` [rad/s].
  double LargestSpeed(double duration) const;
  double end() const { return t_.back(); }

 private:
  std::size_t Segment(double t) const;
  std::vector<double> t_, w_, angle_;
  std::vector<double> acceleration_;  // from each row to the next [rad/s2]
};

}  // namespace ambrig
