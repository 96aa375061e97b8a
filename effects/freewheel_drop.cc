/// Chopper amplifiers: while the switch is off the current freewheels through a diode and the coil
/// sees -drop until its current ends (base model: 0). Other bridges have their drops in the rig
/// file.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription FreewheelDrop() {
  EffectDescription d;
  d.id = "freewheel-drop";
  d.title = "Drop of the freewheeling diode";
  d.physics =
      "While a chopper's switch is off, the coil current runs on through a diode that takes a "
      "nearly\n"
      "constant voltage, so the current falls faster than R alone would make it.";
  d.target = TargetKind::kCoilOrBearing;
  d.needs.freewheeling = true;
  d.parameters = {
      {"drop", "V", 0, 0, 100, 0.2, 2, "voltage against the current while the switch is off"}};
  d.off_when_null = {"drop"};
  d.shows_in = "chopper amplifiers at low duty: mean current below duty times bus over R";
  d.confused_with = "a larger resistance (drop grows with current), amplifier-offset";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double drop = e.Value("drop");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      b.bridge[static_cast<std::size_t>(j)].freewheel_drop += drop;
    });
  };
  return d;
}

}  // namespace ambrig
