/// Both switches of a bridge wait `time` before they turn on: the on-phase starts that much later,
/// its end stays (dV = -2 U_d f_sw time for a bi-state bridge with current flowing).
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription DeadTime() {
  EffectDescription d;
  d.id = "dead-time";
  d.title = "Dead time of the bridges";
  d.physics =
      "Both switches wait before they turn on, so every on-phase is shorter by that time; the "
      "current\n"
      "loop answers with duty, and the ripple shifts within the period.";
  d.target = TargetKind::kRig;
  d.parameters = {
      {"time", "s", 0, 0, 1e-4, 2e-7, 3e-6, "from the command to the switches closing"}};
  d.off_when_null = {"time"};
  d.shows_in = "duty against current, ADC samples just after the start of a period";
  d.confused_with = "amplifier-offset of all coils, a lower bus voltage";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const double time = e.Value("time");
    ForEachTargetCoil(e, plant, [&](BearingPlant& b, int j) {
      b.bridge[static_cast<std::size_t>(j)].dead_time += time;
    });
  };
  return d;
}

}  // namespace ambrig
