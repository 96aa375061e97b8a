#pragma once
/// The current regulator of one coil, a part of the controller: a discrete PI that turns
/// the mean of the last period's ADC samples into a duty. It knows the nominal amplifier only.
///
///   d = d0 + (kp e + integral) / u,   u = 2 U_d with d0 = 0.5, or u = U_d with d0 = 0
///
/// In voltage mode e is the set-point and there is no integral. The duty is clamped to the limits;
/// the integral's increment is dropped when the tentative duty is beyond the limit on the side that
/// e pushes to. The bridge that the duty drives is the plant's:
/// actuators/electronics/power_bridge.h. Source: docs/theory/base_model.md section 3.
#include "actuators/electronics/amplifier_parameters.h"

namespace ambrig {

/// [A] up to which the diodes of a bridge may interrupt a coil's current: no duty holds it.
inline constexpr double kInterruptedCurrent = 0.2;

/// What the amplifier's parameters make of a regulator.
struct RegulatorGains {
  double integral = 0;                   // ki T [V/A]
  double feedback = 1;                   // 0: a voltage follows the set-point, nothing is fed back
  double centre = 0, duty_per_volt = 0;  // duty of zero volts [-], [1/V]
};

class CurrentRegulator {
 public:
  CurrentRegulator() = default;
  /// `nominal` must outlive the regulator.
  explicit CurrentRegulator(const AmplifierParameters& nominal)
      : p_(&nominal),
        gains_{nominal.ki / nominal.switching_frequency, nominal.voltage_mode ? 0.0 : 1.0,
               SwingsBothWays(nominal.modulation) ? 0.5 : 0.0,
               1 / (SwingsBothWays(nominal.modulation) ? 2 * nominal.bus_voltage
                                                       : nominal.bus_voltage)} {}

  /// Duty of the period that begins. `feedback`: mean of last period's samples [A].
  double Duty(double set_point, double feedback) {
    const double e = set_point - gains_.feedback * feedback, increment = gains_.integral * e;
    double d = DutyFromVoltage(p_->kp * e + integral_ + increment);
    const bool above = d > p_->duty_max, below = d < p_->duty_min;
    if (!above && !below) [[likely]] {
      integral_ += increment;
      return d;
    }
    if ((above && e > 0) || (below && e < 0))
      d = DutyFromVoltage(p_->kp * e + integral_);
    else
      integral_ += increment;
    return d < p_->duty_min ? p_->duty_min : (d > p_->duty_max ? p_->duty_max : d);
  }
  /// Integral [V] that holds `current` in a coil of `resistance`; the lower limit for a coil told
  /// kInterruptedCurrent or less.
  void HoldCurrent(double current, double resistance);
  void ResetToLowerLimit();
  double DutyFromVoltage(double u) const { return gains_.centre + u * gains_.duty_per_volt; }
  const RegulatorGains& gains() const { return gains_; }

  double integral() const { return integral_; }
  void set_integral(double value) { integral_ = value; }

 private:
  double VoltageOfDuty(double d) const;

  const AmplifierParameters* p_ = nullptr;
  RegulatorGains gains_;
  double integral_ = 0;  // [V]
};

}  // namespace ambrig
