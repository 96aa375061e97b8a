/// Misaligned coupling: a force at twice the speed, not growing with it (published_values.md 7):
///   f = (c cos 2 theta - s sin 2 theta, c sin 2 theta + s cos 2 theta)
/// The other shaft carries the reaction, not the stator.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription CouplingMisalignment() {
  EffectDescription d;
  d.id = "coupling-misalignment";
  d.title = "Misaligned coupling";
  d.physics =
      "The driving shaft is misaligned with the rotor: the coupling's elements bend twice per turn "
      "and\nexert a force that depends on their stiffness, not on the speed.";
  d.target = TargetKind::kPlane;
  d.needs.rotation = d.needs.levitation = true;
  d.parameters = {{"c", "N", 0, -1e4, 1e4, 0.2, 20, "along x at theta = 0"},
                  {"s", "N", 0, -1e4, 1e4, 0.2, 20, "along y at theta = 0"}};
  d.at_stations = true;
  d.off_when_null = {"c", "s"};
  d.shows_in =
      "turning records: twice per turn, equal force at any speed, so more motion at low speed";
  d.confused_with = "sensor-runout of order 2 (a reading, no force)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const PlaneMap map = TargetForcePlane(e, plant);
    const double c = e.Value("c"), s = e.Value("s");
    AddForceTerm(plant,
                 [=, turning = Turning()](const MotionState& m, RotorForces& forces) mutable {
                   const Turned f = turning.At(c, s, 2 * m.theta);
                   map.AddForce(f.x, f.y, forces.Q);
                 });
  };
  return d;
}

}  // namespace ambrig
