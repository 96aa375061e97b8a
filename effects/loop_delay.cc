/// Set-points reach the current loops `time` later than the record's s channels say; they wait for
/// the next PWM start, so the delay in effect is a whole number of switching periods.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription LoopDelay() {
  EffectDescription d;
  d.id = "loop-delay";
  d.title = "Delay between controller and current loops";
  d.physics =
      "Set-points need time from the controller to the amplifiers and wait there for the next PWM "
      "start:\n"
      "phase falls in proportion to frequency, no gain changes, stability margins shrink.";
  d.target = TargetKind::kRig;
  d.needs.levitation = true;
  d.whole_periods = "time";
  d.parameters = {
      {"time", "s", 0, 0, 5e-3, 4e-5, 4e-4, "beyond the base model's one controller period"}};
  d.off_when_null = {"time"};
  d.shows_in = "levitated records with excitation above 50 Hz: currents lag their set-points";
  d.confused_with =
      "eddy-currents (half-order phase, only force), sensor-lowpass, current-loop gains";
  d.apply = [](const EffectInstance& e, Plant& plant) { plant.loop_delay += e.Value("time"); };
  return d;
}

}  // namespace ambrig
