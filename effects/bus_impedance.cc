/// A supply that is not stiff: source, resistance, then a capacitance at the amplifiers,
/// C dU/dt = (U_source - U)/R - i_drawn. Braking coils feed their energy back and lift the bus.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription BusImpedance() {
  EffectDescription d;
  d.id = "bus-impedance";
  d.title = "Source impedance of the bus";
  d.physics =
      "The supply feeds the amplifiers through a resistance with a capacitance behind it: the bus "
      "sags\n"
      "while coils take power, pumps up while they return it, and all current slopes scale with "
      "it.";
  d.target = TargetKind::kRig;
  d.parameters = {{"resistance", "ohm", 0, 0, 100, 0.02, 0.5, "between source and capacitance"},
                  {"capacitance", "F", 1e-3, 0, 10, 3e-4, 1e-2, "at the amplifiers"}};
  d.off_when_null = {"resistance"};
  d.shows_in = "the bus channel under current steps and strong excitation; all slopes together";
  d.confused_with = "a lower bus voltage; switch drops";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    plant.bus.resistance = e.Value("resistance");
    plant.bus.capacitance = e.Value("capacitance");
  };
  return d;
}

}  // namespace ambrig
