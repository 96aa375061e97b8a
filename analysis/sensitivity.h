#pragma once
/// Sensitivity and margins of every axis, all other loops closed:
///
///   S_a = command after the injection point / injected force excitation,   L_a = 1/S_a - 1
///
/// the loop's return ratio cut at that axis. An AMB's loop is unstable when open, so its gain may
/// neither rise nor fall too far: margins on both sides. Axis by axis they say nothing of changes
/// of several loops at once: disk_margin.h. Source: ISO 14839-3:2006; published_values.md 4.
#include "analysis/disk_margin.h"
#include "analysis/transfer_function.h"

namespace ambrig {

struct AxisSensitivity {
  std::string axis;
  std::vector<std::complex<double>> S;  // on the frequency grid
  double peak = 0, peak_frequency = 0;  // [-], [Hz], up to the standard's highest frequency
  char zone = 'A';                      // ISO 14839-3; D of an unstable loop
  // Factors that the loop's gain may change by before the loop is unstable; infinite or 0: never.
  double gain_up = 0, gain_down = 0;
  // least over the crossovers [rad], [Hz]; negative: none
  double phase_margin = 0, phase_frequency = 0;
  double delay_margin = 0;  // further dead time of this axis alone [s]
  double disk_margin = 0;   // α of this axis alone, as JointMargin's
};

struct Sensitivity {
  double speed = 0;               // [rad/s]
  bool stable = true;             // false: peaks and margins of the axes mean nothing
  std::vector<double> frequency;  // [Hz], below the controller's Nyquist frequency
  std::vector<AxisSensitivity> axes;
  std::vector<JointMargin> joint;  // of all axes that move one another; empty: unstable already
};

/// `rated` [rad/s] sets the standard's highest frequency.
Sensitivity FindSensitivity(const OperatingPoint& point, const TransferFunction& transfer,
                            double rated);

}  // namespace ambrig
