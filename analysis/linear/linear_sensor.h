#pragma once
/// What the position sensors of a bearing make of small motions about a place of the shaft: its
/// maps in their order (rotor/motion/position_sensor.h), differentiated. Run-out and pick-up do not
/// depend on the place and are left out.
#include <Eigen/Dense>
#include <vector>

#include "rotor/motion/position_sensor.h"

namespace ambrig {

struct LinearSensor {
  Eigen::Vector2d reading = Eigen::Vector2d::Zero();    // [m]
  Eigen::Matrix2d slope = Eigen::Matrix2d::Identity();  // d reading / d(x, y) [-]
  std::vector<double> lags;  // first-order lags that the reading passes, time constants [s]
};

/// The reading [m] with the shaft at (x, y) [m], when lags have settled, without signals.
Eigen::Vector2d ReadingAt(const PositionSensor& sensor, const MotionState& motion, double x,
                          double y);

/// With the shaft at (x, y) [m] of the sensor's plane; `motion`: the rest of the rotor's state.
LinearSensor LineariseSensor(const PositionSensor& sensor, const MotionState& motion, double x,
                             double y);

}  // namespace ambrig
