#pragma once
/// Sensitivity as a test engineer measures it: a sine is injected into the force port of one axis
/// of the nonlinear switching rig, and the command after the injection point, read back from the
/// coils' set-points in the record, is divided by it. What a lightly damped mode still rings from
/// the start of the sine is fitted along with its response, at the loop's own computed poles:
/// waiting for a bending mode of 0.3 % would take minutes. Independent reference for
/// analysis/sensitivity.h.
#include <atomic>
#include <complex>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct SineTest {
  std::size_t axis = 0;  // in the order of the rig's axes
  double frequency = 0;  // [Hz], below the controller's Nyquist frequency
  double amplitude = 0;  // [N]
  double speed = 0;      // [rad/s]
  double settle = 0.1;   // [s] before the first sample that counts; what rings on then is fitted
  // that count, at least; the window is a whole number of them as near as ticks allow
  int cycles = 8;
};

/// @throws InputError when the rig cannot run; Interrupted when stopped.
std::complex<double> MeasureSensitivity(const RigParameters& rig, const SineTest& test,
                                        const std::atomic<bool>* stop = nullptr);

}  // namespace ambrig
