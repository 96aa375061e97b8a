/// A supply that is not stiff: source, resistance and choke, then a capacitance at the amplifiers
/// (bus_supply.h). Braking coils feed their energy back and lift the bus, higher where a rectifier
/// takes none of it.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription BusImpedance() {
  EffectDescription d;
  d.id = "bus-impedance";
  d.title = "Source impedance of the bus";
  d.physics =
      "The supply feeds the amplifiers through a resistance, and often a choke,\n"
      "with a capacitor behind it: the bus sags while coils take power, pumps up\n"
      "while they return it (most where a rectifier takes nothing back), and all\n"
      "current slopes scale with it.";
  d.target = TargetKind::kRig;
  d.parameters = {{"resistance", "ohm", 0, 0, 100, 0.02, 0.5, "between source and capacitance"},
                  {"capacitance", "F", 1e-3, 0, 10, 3e-4, 1e-2, "at the amplifiers"},
                  {"inductance", "H", 0, 0, 1, 0, 3e-3, "choke between source and capacitance"},
                  {"series_resistance", "ohm", 0, 0, 10, 0, 0.02, "of the capacitor"},
                  {"rectification", "-", 0, 0, 1, 0, 1,
                   "share of the conductance that a current back into the source lacks"}};
  d.off_when_null = {"resistance"};
  d.shows_in = "the bus channel under current steps and strong excitation; all slopes together";
  d.confused_with = "a lower bus voltage; switch drops";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    plant.bus.resistance = e.Value("resistance");
    plant.bus.capacitance = e.Value("capacitance");
    plant.bus.inductance = e.Value("inductance");
    plant.bus.series_resistance = e.Value("series_resistance");
    plant.bus.rectification = e.Value("rectification");
  };
  return d;
}

}  // namespace ambrig
