#pragma once
/// Parameters of the power amplifier, one bridge with its current regulator per coil. The regulator
/// (control/current/current_regulator.h) is built from the nominal ones, the bridge
/// (actuators/electronics/power_bridge.h) from the true ones.
#include <string>

#include "core/base/parameters.h"

namespace ambrig {

enum class Modulation { kBiState, kTriState, kChopper, kIdeal };

/// Bi-state and tri-state bridges swing over 2 U_d around a duty of 0.5; the others
/// over U_d from 0.
inline bool SwingsBothWays(Modulation m) {
  return m == Modulation::kBiState || m == Modulation::kTriState;
}

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
  /// The coil gets kp volts per ampere of its set-point and nothing is fed back; else
  /// its current follows.
  bool voltage_mode = false;
  double bandwidth = 0;  // [Hz] of the current loop, which kp and ki follow from; 0: they are given
  double delay = 0;      // [s] of the set-points on their way, in whole switching periods
  double adc_jitter = 0, edge_jitter = 0;           // [s rms]
  double edge_spread = 0, current_gain_spread = 0;  // [s], [-] sd over the coils
  double unit = 1;
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

/// Beside them, in a table of their own: a commissioning knows an amplifier by the numbers above.
inline constexpr Field<AmplifierParameters> kAmplifierModeFields[] = {
    {"bandwidth", &AmplifierParameters::bandwidth, "Hz", 0, 1e6,
     "of the current loop, in place of kp and ki; 0: they are given"},
    {"delay", &AmplifierParameters::delay, "s", 0, 0.1,
     "set-points reach the current loops this much later"},
};

/// Errors of the hardware that its maker knows by their size only; nothing of
/// the controller's model.
inline constexpr Field<AmplifierParameters> kAmplifierErrorFields[] = {
    {"adc_jitter", &AmplifierParameters::adc_jitter, "s", 0, 1e-5,
     "rms of the instants of the ADC samples, one clock for all coils"},
    {"edge_jitter", &AmplifierParameters::edge_jitter, "s", 0, 1e-5,
     "rms of the instants at which a bridge switches, from period to period"},
    {"edge_spread", &AmplifierParameters::edge_spread, "s", 0, 1e-5,
     "sd over the coils of the instants at which their bridges switch: dead times that are not "
     "known"},
    {"current_gain_spread", &AmplifierParameters::current_gain_spread, "-", 0, 0.1,
     "sd over the coils of the gains of their current measurements"},
    {"unit", &AmplifierParameters::unit, "-", 1, 1e9,
     "which rig of its type: another number, other draws from the two spreads"},
};

}  // namespace ambrig
