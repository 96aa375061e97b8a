#include "rotor/motion/speed_sensor.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/noise.h"

namespace ambrig {

namespace {
constexpr std::uint32_t kMissedPulses = 101;  // stream of random numbers
}  // namespace

void SpeedSensor::Start(const MotionState& s, std::uint64_t seed) {
  seed_ = seed;
  t_ = pulse_time_ = s.t;
  phase_ = s.theta * p_.pulses_per_revolution / (2 * kPi);
  pending_ = 0;
  timed_ = false;
  wheel_ = reading_ = s.Omega;
}

bool SpeedSensor::Seen(long long pulse) const {
  return p_.missed_pulses == 0 ||
         Uniform(seed_, kMissedPulses, static_cast<std::uint32_t>(pulse)) >= p_.missed_pulses;
}

double SpeedSensor::TimeOf(double t) const {
  return p_.clock > 0 ? std::floor(t / p_.clock) * p_.clock : t;
}

void SpeedSensor::TakePulses(double t, double phase) {
  // Pulse k comes where the phase passes the integer k, upwards or downwards.
  const int sign = phase > phase_ ? 1 : -1;
  const auto below = static_cast<long long>(std::floor(std::min(phase, phase_)));
  const auto above = static_cast<long long>(std::floor(std::max(phase, phase_)));
  long long last = 0;
  bool seen = false;
  for (long long k = 1; k <= above - below; ++k) {
    const long long pulse = sign > 0 ? below + k : above + 1 - k;
    if (!Seen(pulse)) continue;
    pending_ += sign;
    last = pulse;
    seen = true;
  }
  if (!seen) return;
  const double share = (static_cast<double>(last) - phase_) / (phase - phase_);
  const double at = TimeOf(t_ + share * (t - t_));
  if (timed_ && at <= pulse_time_) return;  // the timer cannot tell the pulses apart yet
  if (timed_)
    wheel_ =
        2 * kPi / p_.pulses_per_revolution * static_cast<double>(pending_) / (at - pulse_time_);
  timed_ = true;
  pulse_time_ = at;
  pending_ = 0;
}

void SpeedSensor::ReadWheel(const MotionState& s) {
  const double dt = s.t - t_;
  double speed = s.Omega;
  if (p_.pulses_per_revolution > 0) {
    const double phase = s.theta * p_.pulses_per_revolution / (2 * kPi);
    TakePulses(s.t, phase);
    phase_ = phase;
    const double since = s.t - pulse_time_, most = 2 * kPi / p_.pulses_per_revolution;
    speed = std::abs(wheel_) * since > most ? std::copysign(most / since, wheel_) : wheel_;
  }
  t_ = s.t;
  reading_ = p_.lag > 0 ? speed + (reading_ - speed) * std::exp(-dt / p_.lag) : speed;
}

}  // namespace ambrig
