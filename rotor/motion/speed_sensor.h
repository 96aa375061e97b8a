#pragma once
/// The speed sensor of a rig, a part of the plant: controllers get its reading, never the true
/// speed. A wheel with P teeth turns with the shaft; two tracks tell the direction. The time of
/// every pulse that is seen is taken by a timer, and the speed follows from the pulses n seen since
/// the last reading (M/T method, Ohmae et al. 1982, IEEE Trans. Ind. Appl. IA-18(3), 207-211):
///
///   reading = (2 pi / P) n / (t_last - t_before)
///
/// with t_last and t_before the times of the last pulse now and at the reading before.
/// Without a new pulse the reading stays, but never above what the time since the last one
/// allows. Behind it stands a first-order lag. An ideal sensor (P = 0) reads the speed itself. A
/// mark on the shaft tells the angle, without an error.
#include <cstdint>

#include "rotor/linear/force_term.h"
#include "rotor/motion/speed_sensor_parameters.h"

namespace ambrig {

class SpeedSensor {
 public:
  SpeedSensor() = default;
  explicit SpeedSensor(const SpeedSensorParameters& p) : p_(p) {}

  /// The shaft has been turning with this speed for long. `seed`: of the pulses that are missed.
  void Start(const MotionState& s, std::uint64_t seed);
  /// Reads the shaft; called in order of time. Between two calls it turns evenly.
  void Read(const MotionState& s) {
    angle_ = s.theta;
    if (p_.pulses_per_revolution == 0 && p_.lag == 0)
      reading_ = s.Omega;
    else
      ReadWheel(s);
  }
  double reading() const { return reading_; }  // [rad/s]
  double angle() const { return angle_; }      // [rad]

 private:
  void ReadWheel(const MotionState& s);
  void TakePulses(double t, double phase);
  bool Seen(long long pulse) const;
  double TimeOf(double t) const;

  SpeedSensorParameters p_;
  std::uint64_t seed_ = 0;
  double t_ = 0, phase_ = 0;  // of the last call [s], [pulses]
  double pulse_time_ = 0;     // t_before: up to which pulses are in `wheel_` [s]
  long long pending_ = 0;     // pulses seen since, signed
  bool timed_ = false;        // pulse_time_ is that of a pulse
  double wheel_ = 0;          // speed by the pulses [rad/s]
  double reading_ = 0;        // [rad/s]
  double angle_ = 0;          // [rad]
};

}  // namespace ambrig
