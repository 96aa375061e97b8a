/// Unbalanced magnetic pull of a motor (or a magnet coupling):  f = k (r - e)  along the
/// displacement from the motor's own centre e, a negative stiffness; the stator feels the opposite.
/// k = pi R L B²/(2 mu0 g) (published_values.md 7).
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription SidePull() {
  EffectDescription d;
  d.id = "side-pull";
  d.title = "Unbalanced magnetic pull of a motor";
  d.physics =
      "The field of a motor attracts the rotor in the direction of its displacement (UMP): a "
      "negative\nstiffness at one plane, independent of the bearing's currents.";
  d.target = TargetKind::kPlaneOrZ;
  d.needs.levitation = true;
  d.parameters = {
      {"stiffness", "N/m", 0, -1e8, 1e8, 1e4, 5e5, "k of f = k (r - e); > 0 destabilises"},
      {"ex", "m", 0, -1e-3, 1e-3, -3e-5, 3e-5, "centre of the motor beside the sensors' zero"},
      {"ey", "m", 0, -1e-3, 1e-3, -3e-5, 3e-5, "centre of the motor beside the sensors' zero"}};
  d.at_stations = true;
  d.off_when_null = {"stiffness"};
  d.positive = "stiffness";
  d.shows_in = "force excitation at low frequency; reference steps; static currents off centre";
  d.confused_with = "gap of that bearing (its negative stiffness grows with the bias), sensor-gain";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const PlaneMap map = TargetForcePlane(e, plant);
    const double k = e.Value("stiffness"), ex = e.Value("ex"), ey = e.Value("ey");
    const bool radial = map.count > 0 && map.dof[0] != 2;
    AddForceTerm(plant, [=](const MotionState& m, RotorForces& forces) {
      // Along its one axis at an opposed pair (weights cos, sin), along z at a thrust bearing.
      const double fx = k * (map.X(m.q) - ex), fy = k * (map.Y(m.q) - ey);
      DofVector before = forces.Q;
      map.AddForce(fx, fy, forces.Q);
      if (!radial) return;
      forces.stator_x += forces.Q[0] - before[0];
      forces.stator_y += forces.Q[1] - before[1];
    });
  };
  return d;
}

}  // namespace ambrig
