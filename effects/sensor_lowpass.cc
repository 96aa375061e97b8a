/// First-order sensor electronics:  tau y' = u - y,  tau = 1/(2 pi cutoff).
/// Between two calls u runs straight from u0 to u1 (slope s over dt), for which exactly
///   y1 = u1 - s tau + (y0 - u0 + s tau) exp(-dt/tau).
/// The first reading of a run is settled: y = u. Range 2 to 20 kHz (published_values.md 7).
#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

struct Lowpass {
  double tau;
  bool settled = false;
  double t = 0, u[2] = {}, y[2] = {};

  void operator()(const MotionState& state, double* a, double* b) {
    const double next[2] = {*a, *b};
    const double dt = state.t - t;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!settled) {
        y[k] = next[k];
      } else if (dt > 0) {
        const double lag = (next[k] - u[k]) / dt * tau;
        y[k] = next[k] - lag + (y[k] - u[k] + lag) * std::exp(-dt / tau);
      }
      u[k] = next[k];
    }
    settled = true;
    t = state.t;
    *a = y[0];
    *b = y[1];
  }
};

}  // namespace

EffectDescription SensorLowpass() {
  EffectDescription d;
  d.id = "sensor-lowpass";
  d.title = "Bandwidth of the position sensors";
  d.physics =
      "The sensor electronics follow the motion as a first-order low-pass: the controller sees "
      "the\n"
      "position late and loses phase, so damping, above a few hundred hertz.";
  d.target = TargetKind::kPlaneOrRig;
  d.needs.levitation = true;
  d.parameters = {{"cutoff", "Hz", kInfinity, 10, kInfinity, 300, 2e4, "-3 dB frequency"}};
  d.off_when_null = {"cutoff"};
  d.shows_in = "wide-band force excitation: less damping; clamped records do not show it";
  d.confused_with =
      "loop-delay (moves the currents too), eddy-currents (seen between current and force)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double tau = 1 / (2 * kPi * e.Value("cutoff"));
    const bool everywhere = e.target == "rig";
    for (BearingPlant& b : plant.bearings)
      if (everywhere || b.name == e.target)
        AddMap(b.sensor, ReadingStage::kElectronics, Lowpass{tau});
  };
  return d;
}

}  // namespace ambrig
