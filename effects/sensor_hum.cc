/// Mains hum picked up by the cables of a plane's sensors:
///   reading += c cos(2 pi f t) + s sin(2 pi f t),  both sensors alike, t the record's time, so
///   that
/// the phase is the same in every record (effects.md). Not filtered by the sensor electronics.
#include <cmath>

#include "core/math/constants.h"
#include "effects/effects_motion.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription SensorHum() {
  EffectDescription d;
  d.id = "sensor-hum";
  d.title = "Mains hum on position sensors";
  d.physics =
      "The cables of both sensors of a plane pick up the mains: a sine at a fixed frequency is "
      "read as\n"
      "motion along the diagonal, and the bearing answers with a force.";
  d.target = TargetKind::kPlane;
  d.parameters = {{"frequency", "Hz", 50, 0.1, 1e4, 50, 300, "50 or 60 Hz, or a multiple"},
                  {"c", "m", 0, -1e-3, 1e-3, 2e-7, 1e-5, "cosine at t = 0 of the record"},
                  {"s", "m", 0, -1e-3, 1e-3, 2e-7, 1e-5, "sine at t = 0 of the record"}};
  d.off_when_null = {"c", "s"};
  d.shows_in = "every levitated record, quiet ones best: a line that does not move with the speed";
  d.confused_with = "base-vibration (acts on all planes as a force), unbalance at that very speed";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double w = 2 * kPi * e.Value("frequency"), c = e.Value("c"), s = e.Value("s");
    const bool one_axis = TargetPlane(e, plant).opposed;
    AddMap(TargetPlane(e, plant).sensor, ReadingStage::kPickUp,
           [=](const MotionState& state, double* x, double* y) {
             const double hum = c * std::cos(w * state.t) + s * std::sin(w * state.t);
             *x += hum;
             if (!one_axis) *y += hum;
           });
  };
  return d;
}

}  // namespace ambrig
