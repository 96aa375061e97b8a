#pragma once
/// Power amplifier: one bridge per coil, its own instance. The PI current loop of one coil turns
/// the mean of last period's ADC samples into a duty; the bridge turns the duty into a voltage
/// pattern of this period.
///
///   bi-state  on +U_d - 2 U_s, off -(U_d + 2 U_c);      tri-state adds freewheeling -(U_s + U_c)
///   chopper   on +U_d, off 0 (freewheel diode ideal);    ideal      duty * U_d
///   d = d0 + (kp e + integral) / (2 U_d or U_d), clamped to duty_limits with the increment of the
///   integral dropped when the tentative d is beyond the limit on the side that e pushes to.
///
/// Source: docs/theory/base_model.md section 3; [loadcurrentslope] Eq. 1, 5, 11.
#include <string>

#include "core/base/parameters.h"

namespace ambrig {

enum class Modulation { kBiState, kTriState, kChopper, kIdeal };

struct AmplifierParameters {
  double bus_voltage = kRequired;
  double switch_drop = 0;
  double diode_drop = 0;
  double switching_frequency = kRequired;
  double kp = kRequired;
  double ki = kRequired;
  double adc_samples_per_period = 18;
  double adc_bits = 12;
  double adc_range = 10;
  double current_noise = 0;
  double bus_noise = 0;
  double i_max = kRequired;
  double quadrants = 2;
  double duty_min = 0.02, duty_max = 0.98;  // duty_limits = [min, max]
  Modulation modulation = Modulation::kBiState;
};

inline constexpr Field<AmplifierParameters> kAmplifierFields[] = {
    {"bus_voltage", &AmplifierParameters::bus_voltage, "V", 1e-3, 1e5, "U_d"},
    {"switch_drop", &AmplifierParameters::switch_drop, "V", 0, 100, "U_s, per switch"},
    {"diode_drop", &AmplifierParameters::diode_drop, "V", 0, 100, "U_c, per diode"},
    {"switching_frequency", &AmplifierParameters::switching_frequency, "Hz", 10, 1e7, "f_sw"},
    {"kp", &AmplifierParameters::kp, "V/A", 0, 1e6, "proportional gain of the current loop"},
    {"ki", &AmplifierParameters::ki, "V/(A s)", 0, 1e9, "integral gain of the current loop"},
    {"adc_samples_per_period", &AmplifierParameters::adc_samples_per_period, "-", 2, 64,
     "current samples per switching period"},
    {"adc_bits", &AmplifierParameters::adc_bits, "-", 4, 24, "resolution, signed over the range"},
    {"adc_range", &AmplifierParameters::adc_range, "A", 1e-3, 1e5, "reads -range to +range"},
    {"current_noise", &AmplifierParameters::current_noise, "A", 0, 1e3, "rms per ADC sample"},
    {"bus_noise", &AmplifierParameters::bus_noise, "V", 0, 1e3, "rms of the bus voltage reading"},
    {"i_max", &AmplifierParameters::i_max, "A", 1e-6, 1e5, "largest set-point"},
    {"quadrants", &AmplifierParameters::quadrants, "-", 2, 4,
     "2: currents never negative; 4: any sign"},
};

/// Voltage of one coil over one period: three pieces, each gain * bus + drop.
struct CoilVoltage {
  double t1 = 0, t2 = 0;       // [s] ends of the first and second piece
  double gain[3] = {0, 0, 0};  // [-]
  double drop[3] = {0, 0, 0};  // [V]
};

/// What an effect or a fault may change of one coil's bridge.
struct BridgeImperfection {
  double dead_time = 0;       // [s] both switches wait before they turn on
  double freewheel_drop = 0;  // [V] chopper: the coil sees -drop while the switch is off
  double voltage_offset = 0;  // [V] constant error
  double dead_duty = 0;       // [-] duty below which nothing comes out
  bool off = false;           // amplifier-off
  bool stuck_on = false;      // switch-stuck-on
};

class PowerAmplifier {
 public:
  PowerAmplifier() = default;
  explicit PowerAmplifier(const AmplifierParameters& p)
      : p_(&p),
        integral_gain_(p.ki / p.switching_frequency),
        centre_(Swings() ? 0.5 : 0),
        duty_per_volt_(1 / (Swings() ? 2 * p.bus_voltage : p.bus_voltage)) {}

  /// Duty that the current loop asks for at t_n. `feedback` is the mean of last period's samples
  /// [A].
  double CurrentLoop(double set_point, double feedback) {
    const double e = set_point - feedback, increment = integral_gain_ * e;
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
  /// 0.2 A or less.
  void HoldCurrent(double current, double resistance);
  void ResetToLowerLimit();
  double DutyFromVoltage(double u) const { return centre_ + u * duty_per_volt_; }
  /// The bridge's voltages in a period with duty d.
  CoilVoltage Pattern(double duty, const BridgeImperfection& bridge) const;

  double integral() const { return integral_; }
  void set_integral(double value) { integral_ = value; }

 private:
  /// Bi-state and tri-state bridges swing over 2 U_d around d = 0.5; the others over U_d from 0.
  bool Swings() const {
    return p_->modulation == Modulation::kBiState || p_->modulation == Modulation::kTriState;
  }
  double VoltageOfDuty(double d) const;

  const AmplifierParameters* p_ = nullptr;
  double integral_gain_ = 0;               // ki T [V/A]
  double centre_ = 0, duty_per_volt_ = 0;  // duty of zero volts [-], [1/V]
  double integral_ = 0;                    // [V]
};

}  // namespace ambrig
