#include "control/current/current_regulators.h"

#include "actuators/magnetics/lane_vector.h"

namespace ambrig {

namespace {

/// The duties of eight coils, all at once, where none is beyond a limit; false: nothing was done.
AMBRIG_WIDE bool DutiesInside(const RegulatorGains& g, const AmplifierParameters& p,
                              const double* set_point, const double* feedback, double* integral,
                              double* duty) {
  const LaneVector e = Load(set_point) - Load(feedback) * g.feedback, increment = e * g.integral;
  const LaneVector before = Load(integral);
  const LaneVector d = LaneVector(g.centre) + (e * p.kp + before + increment) * g.duty_per_volt;
  if (!(Largest(d) <= p.duty_max && -Largest(-d) >= p.duty_min)) return false;
  Store(integral, before + increment);
  Store(duty, d);
  return true;
}

}  // namespace

void CurrentRegulators::HoldCurrent(std::size_t j, double current, double resistance) {
  CurrentRegulator one = any_;
  one.HoldCurrent(current, resistance);
  integral_.v[j] = one.integral();
}

void CurrentRegulators::ResetToLowerLimit() {
  CurrentRegulator one = any_;
  one.ResetToLowerLimit();
  for (double& integral : integral_.v) integral = one.integral();
}

void CurrentRegulators::Duties(const Lane& set_point, const Lane& feedback, int coils, Lane* duty) {
  if (coils == kLanes &&
      DutiesInside(any_.gains(), *nominal_, set_point.v, feedback.v, integral_.v, duty->v))
    return;
  for (int j = 0; j < coils; ++j) {
    CurrentRegulator one = (*this)[static_cast<std::size_t>(j)];
    (*duty)[j] = one.Duty(set_point[j], feedback[j]);
    integral_[j] = one.integral();
  }
}

}  // namespace ambrig
