/// Internal damping: friction that turns with the shaft (shrink fits, sleeves, composite shafts).
///   f = -d (r' - i Omega r),  i.e.  fx = -d (x' + Omega y),  fy = -d (y' - Omega x)
/// damps a mode of frequency w below Omega = w and drives its forward whirl above.
/// With bending modes in the rig, r is the bent part of the displacement at the radial planes (a
/// rigid body does not deform); without, r is the displacement itself. d is the total: n planes
/// carry d/n each.
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

constexpr int kRigidDofs = 5;

PlaneMap BentPart(const PlaneMap& plane) {
  PlaneMap bent;
  bent.z = plane.z;
  for (std::size_t k = 0; k < static_cast<std::size_t>(plane.count); ++k)
    if (plane.dof[k] >= kRigidDofs) bent.Add(plane.dof[k], plane.wx[k], plane.wy[k]);
  return bent;
}

}  // namespace

EffectDescription RotatingDamping() {
  EffectDescription d;
  d.id = "rotating-damping";
  d.title = "Internal (rotating) damping";
  d.physics =
      "Friction inside the shaft or its fits acts on the motion seen by the turning rotor: above "
      "a\nmode's frequency it destabilises the forward whirl of that mode instead of damping it.";
  d.target = TargetKind::kRig;
  d.needs.rotation = d.needs.levitation = true;
  d.parameters = {{"damping", "N s/m", 0, 0, 1e6, 1, 1e3, "d, shared by the radial planes"}};
  d.off_when_null = {"damping"};
  d.shows_in = "fast records with force excitation: forward whirl less damped, backward more";
  d.confused_with = "cross-coupling (one plane, no speed in it), sensor-lowpass (both whirls)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    const bool flexible = !plant.rotor.modes().empty();
    std::vector<PlaneMap> planes;
    for (const BearingPlant& b : plant.bearings)
      if (!b.thrust && !b.opposed) planes.push_back(flexible ? BentPart(b.plane) : b.plane);
    const double share =
        planes.empty() ? 0 : e.Value("damping") / static_cast<double>(planes.size());
    AddForceTerm(plant, [=](const MotionState& m, RotorForces& forces) {
      for (const PlaneMap& p : planes)
        p.AddForce(-share * (p.X(m.v) + m.Omega * p.Y(m.q)),
                   -share * (p.Y(m.v) - m.Omega * p.X(m.q)), forces.Q);
    });
  };
  return d;
}

}  // namespace ambrig
