/// Unbalance u = (c, s) at a plane: an offset mass pushes the rotor with -d²/dt² of its place,
///   f = u (Omega² r - Omega' t),  r = (cos theta, sin theta) turned by u's phase, t = r + 90
///   degrees,
/// the second term being the tangential part of a run-up. The spin torque of the rotor's own
/// acceleration on u (of order u a) is left out: it is below windage by orders of magnitude.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription Unbalance() {
  EffectDescription d;
  d.id = "unbalance";
  d.title = "Unbalance";
  d.physics =
      "Mass off the axis pulls on the rotor once per turn with u Omega², forward circular; one "
      "plane\n"
      "takes a static unbalance, both planes are needed for a couple.";
  d.target = TargetKind::kPlane;
  d.needs.rotation = d.needs.levitation = true;
  d.parameters = {
      {"c", "kg m", 0, -1e-2, 1e-2, 1e-6, 1e-4, "along the rotor's mark (x at theta = 0)"},
      {"s", "kg m", 0, -1e-2, 1e-2, 1e-6, 1e-4, "90 degrees ahead of the mark"}};
  d.at_stations = true;
  d.off_when_null = {"c", "s"};
  d.shows_in = "turning records, run-ups best: once per turn, growing with the square of the speed";
  d.confused_with = "sensor-runout, shaft-bow (both stay at slow roll); at one speed not separable";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const PlaneMap map = TargetForcePlane(e, plant);
    const double c = e.Value("c"), s = e.Value("s");
    AddForceTerm(
        plant, [=, turning = Turning()](const MotionState& m, RotorForces& forces) mutable {
          const Turned u = turning.At(c, s, m.theta);
          const double w2 = m.Omega * m.Omega;
          map.AddForce(w2 * u.x + m.Omega_dot * u.y, w2 * u.y - m.Omega_dot * u.x, forces.Q);
        });
  };
  return d;
}

}  // namespace ambrig
