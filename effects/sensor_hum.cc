/// Mains hum picked up by the cables of a plane's sensors:
///   reading += Σ_n c_n cos(2 pi n f t) + s_n sin(2 pi n f t),  n = 1, 3, 5,
/// both sensors alike, t the record's time, so that the phase is the same in every record
/// (docs/effects.md). Rectifiers on the mains make odd harmonics. Not filtered by the sensor
/// electronics.
#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription SensorHum() {
  EffectDescription d;
  d.id = "sensor-hum";
  d.title = "Mains hum on position sensors";
  d.physics =
      "The cables of both sensors of a plane pick up the mains: a sine at a fixed frequency is "
      "read as\nmotion along the diagonal, and the controller responds with a force.";
  d.target = TargetKind::kPlane;
  d.tone = d.mains = true;
  d.parameters = {{"frequency", "Hz", 50, 0.1, 1e4, 50, 300, "50 or 60 Hz, or a multiple"},
                  {"c", "m", 0, -1e-3, 1e-3, 2e-7, 1e-5, "cosine at t = 0 of the record"},
                  {"s", "m", 0, -1e-3, 1e-3, 2e-7, 1e-5, "sine at t = 0 of the record"},
                  {"c3", "m", 0, -1e-3, 1e-3, 5e-8, 2e-6, "third harmonic, cosine"},
                  {"s3", "m", 0, -1e-3, 1e-3, 5e-8, 2e-6, "third harmonic, sine"},
                  {"c5", "m", 0, -1e-3, 1e-3, 5e-8, 2e-6, "fifth harmonic, cosine"},
                  {"s5", "m", 0, -1e-3, 1e-3, 5e-8, 2e-6, "fifth harmonic, sine"}};
  d.off_when_null = {"c", "s", "c3", "s3", "c5", "s5"};
  d.adds_signal = true;
  d.shows_in = "every levitated record, quiet ones best: a line that does not move with the speed";
  d.confused_with = "base-vibration (acts on all planes as a force), unbalance at that very speed";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double w = 2 * kPi * e.Value("frequency");
    const std::array<double, 3> c = {e.Value("c"), e.Value("c3"), e.Value("c5")};
    const std::array<double, 3> s = {e.Value("s"), e.Value("s3"), e.Value("s5")};
    const bool one_axis = TargetPlane(e, plant).opposed;
    AddMap(TargetPlane(e, plant).sensor, ReadingStage::kPickUp,
           [=](const MotionState& state, double* x, double* y) {
             double hum = 0;
             for (std::size_t k = 0; k < c.size(); ++k) {
               const double phase = static_cast<double>(2 * k + 1) * w * state.t;
               hum += c[k] * std::cos(phase) + s[k] * std::sin(phase);
             }
             *x += hum;
             if (!one_axis) *y += hum;
           });
  };
  return d;
}

}  // namespace ambrig
