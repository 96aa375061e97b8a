#pragma once
/// What the linear closed loop of a rig and a controller says, sampled, at one speed.
#include "control/linear/sampled_plant.h"
#include "control/position/position_controller.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct LinearFigures {
  double spectral_radius = 0;            // of the closed loop's state matrix; below 1: stable
  double settling_time = kInfinity;      // time constant of its slowest pole [s]
  double peak_sensitivity = kInfinity;   // largest |S_kk| over axes and frequencies [-]
  std::vector<double> axis_sensitivity;  // the same per axis [-]
  // largest rms force command over the axes due to the sensors' noise [N]
  double noise_force = kInfinity;
  // 1/(2 zeta) of the least damped pole up to the highest speed [-]
  double amplification = 0;
  bool stable() const { return spectral_radius < 1; }
};

/// S = (I - K P)^-1 per axis, all other loops closed: from an excitation of the force command to
/// the command with it, as the analysis and a measurement have it (analysis/sensitivity.h), over
/// 0.5 Hz to max(2 kHz, three times the speed), below the Nyquist frequency, as ISO 14839-3 wants
/// it, the frequencies of the loop's lightly damped poles among them. `plant`: true values; `K`:
/// readings to forces; `noise` [m] per axis. The largest is taken over `axes`. `top` [rad/s]: poles
/// up to it count for the amplification, as an unbalance excites them in a run-up (API 617's
/// amplification factor is 1/(2 zeta) of a single mode).
LinearFigures LinearFiguresOf(const SampledPlant& plant, const StateSpace& K,
                              const std::vector<double>& noise, double Omega,
                              const std::vector<std::size_t>& axes, double top = 0);

/// |S_kk| of one axis at these frequencies [Hz].
std::vector<double> SensitivityCurve(const SampledPlant& plant, const StateSpace& K,
                                     std::size_t axis, const std::vector<double>& hertz);

/// The response of the readings [m] (axes x samples) to a step of 1 N at t = 0, at the magnets of
/// axis `axis`.
Eigen::MatrixXd LoadStep(const SampledPlant& plant, const StateSpace& K, std::size_t axis,
                         std::size_t samples);

}  // namespace ambrig
