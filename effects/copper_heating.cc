/// Copper that warms up: R = R20 (1 + 0.00393 dT), dT = dT_slow + dT_fast, each with
///   time_constant dT' = rise_per_watt R i² - dT,
/// dT = 0 at the start of every record (docs/effects.md). Each coil on its own. Two lags in a row of
/// heat paths (winding - iron - housing) are the sum of two such terms (Foster's network).
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription CopperHeating() {
  EffectDescription d;
  d.id = "copper-heating";
  d.title = "Heating of the copper";
  d.physics =
      "Copper loss warms each coil, and its resistance grows by 0.393 % per kelvin; the current "
      "loops\n"
      "answer with more duty. The winding follows its loss against the iron in a short time "
      "(fast), "
      "the iron\nagainst the housing in a long one.";
  d.target = TargetKind::kBearing;
  d.parameters = {
      {"rise_per_watt", "K/W", 0, 0, 1000, 2, 50, "temperature rise over copper loss, settled"},
      {"time_constant", "s", 1, 1e-3, 1e5, 0.1, 100, "thermal"},
      {"fast_rise", "K/W", 0, 0, 1000, 1, 30,
       "the winding's rise over copper loss against the iron"},
      {"fast_time_constant", "s", 0.1, 1e-3, 1e3, 0.06, 0.2, "of the winding against the iron"}};
  d.off_when_null = {"rise_per_watt", "fast_rise"};
  d.shows_in =
      "long records at high current: slow drift of the current ripple's mean and of the duty";
  d.confused_with = "a larger resistance (constant), bus sag";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    BearingPlant& b = TargetBearing(e, plant);
    b.heating.slow.rise_per_watt = e.Value("rise_per_watt");
    b.heating.slow.time_constant = e.Value("time_constant");
    b.heating.fast.rise_per_watt = e.Value("fast_rise");
    b.heating.fast.time_constant = e.Value("fast_time_constant");
  };
  return d;
}

}  // namespace ambrig
