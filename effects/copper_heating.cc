/// Copper that warms up: R = R20 (1 + 0.00393 dT), time_constant dT' = rise_per_watt P - dT,
/// dT = 0 at the start of every record (docs/effects.md). P = (1 - shared) R i² + shared mean(R i²)
/// over the coils of the bearing: the iron of a stator carries heat from coil to coil.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription CopperHeating() {
  EffectDescription d;
  d.id = "copper-heating";
  d.title = "Heating of the copper";
  d.physics =
      "Copper loss warms the coils with one thermal time constant, and their resistance grows by "
      "0.393 %\n"
      "per kelvin; the current loops answer with more duty. The stator's iron carries a share of "
      "the "
      "heat\nfrom coil to coil: with shared = 1 all coils of a bearing are equally warm.";
  d.target = TargetKind::kBearing;
  d.parameters = {
      {"rise_per_watt", "K/W", 0, 0, 1000, 2, 50, "temperature rise over copper loss, settled"},
      {"time_constant", "s", 1, 1e-3, 1e5, 0.1, 100, "thermal"},
      {"shared", "-", 0, 0, 1, 0.3, 1,
       "share of the loss that warms all coils of the bearing alike"}};
  d.off_when_null = {"rise_per_watt"};
  d.shows_in =
      "long records at high current: slow drift of the current ripple's mean and of the duty";
  d.confused_with = "a larger resistance (constant), bus sag";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    BearingPlant& b = TargetBearing(e, plant);
    b.heating.rise_per_watt = e.Value("rise_per_watt");
    b.heating.time_constant = e.Value("time_constant");
    b.heating.shared = e.Value("shared");
  };
  return d;
}

}  // namespace ambrig
