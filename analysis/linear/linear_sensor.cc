#include "analysis/linear/linear_sensor.h"

namespace ambrig {

Eigen::Vector2d ReadingAt(const PositionSensor& sensor, const MotionState& motion, double x,
                          double y) {
  Eigen::Vector2d r(x, y);
  for (const auto& map : sensor.maps)
    if (!map->signal() && map->lag() == 0) map->Map(motion, &r.x(), &r.y());
  return r;
}

LinearSensor LineariseSensor(const PositionSensor& sensor, const MotionState& motion, double x,
                             double y) {
  constexpr double kStep = 1e-7;  // [m]
  const auto read = [&](double at_x, double at_y) { return ReadingAt(sensor, motion, at_x, at_y); };
  LinearSensor out;
  out.reading = read(x, y);
  out.slope.col(0) = (read(x + kStep, y) - read(x - kStep, y)) / (2 * kStep);
  out.slope.col(1) = (read(x, y + kStep) - read(x, y - kStep)) / (2 * kStep);
  for (const auto& map : sensor.maps)
    if (map->lag() > 0) out.lags.push_back(map->lag());
  return out;
}

}  // namespace ambrig
