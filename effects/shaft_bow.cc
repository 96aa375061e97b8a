/// A bent shaft: the surface at z runs off the mass axis by
///   b(z) = (c, s) (u + even u² + cubic u³)/sqrt(1 + even² + cubic²),  u = z/z_ref,
///   z_ref the largest |z| of the radial bearing planes,
/// turned by theta, whatever the speed. It moves gaps, journals and readings; the mass axis itself
/// is the model's coordinate, so at equal b everywhere a bow would be an unbalance: hence the shape
/// vanishes at the centre of mass. The root keeps (c, s) the size of the bow whatever its shape, so
/// that a fit may end where u has no part. Size 1 to 30 um (published_values.md 7).
///
/// The bend lies in one plane. With a shape for each of two planes a bow would be any two
/// unbalances of a rigid rotor, which have their own angles.
#include <algorithm>
#include <cmath>

#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

class Bow : public SurfaceTerm {
 public:
  Bow(double c, double s, double even, double cubic, double reference)
      : c_(c / std::hypot(1, even, cubic)),
        s_(s / std::hypot(1, even, cubic)),
        even_(even),
        cubic_(cubic),
        reference_(reference) {}
  void Add(const MotionState& state, double z, double* dx, double* dy) const override {
    const double u = z / reference_, shape = u * (1 + u * (even_ + u * cubic_));
    const Turned b = turning_.At(c_ * shape, s_ * shape, state.theta);
    *dx += b.x;
    *dy += b.y;
  }

 private:
  double c_, s_;         // over the root [m]
  double even_, cubic_;  // [-]
  double reference_;     // [m]
  mutable Turning turning_;
};

}  // namespace

EffectDescription ShaftBow() {
  EffectDescription d;
  d.id = "shaft-bow";
  d.title = "Bent shaft";
  d.physics =
      "The shaft's surface runs off its mass axis, at one end opposite or unequal to the other: "
      "sensors read it\n"
      "and the magnets' gaps follow it once per turn, the same size at any speed.";
  d.target = TargetKind::kRig;
  d.needs.rotation = d.needs.levitation = true;
  d.parameters = {
      {"c", "m", 0, -1e-3, 1e-3, 1e-6, 3e-5,
       "along the mark; without even and cubic at z = + the largest |z| of the bearing planes"},
      {"s", "m", 0, -1e-3, 1e-3, 1e-6, 3e-5, "90 degrees ahead of the mark"},
      {"even", "-", 0, -20, 20, -1, 1, "part that is equal at both ends and grows with z squared"},
      {"cubic", "-", 0, -20, 20, -1, 1, "part that grows with z cubed"}};
  d.off_when_null = {"c", "s"};
  d.shows_in = "slow-roll and turning records: once per turn, other at the two planes";
  d.confused_with =
      "sensor-runout (one plane, gaps unmoved), unbalance (grows with the square of the speed)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    double reference = 0;
    for (const auto& [name, z] : plant.planes) reference = std::max(reference, std::abs(z));
    if (reference == 0) reference = 1;  // planes at the centre of mass see no bow
    plant.rotor.surface.push_back(std::make_unique<Bow>(e.Value("c"), e.Value("s"), e.Value("even"),
                                                        e.Value("cubic"), reference));
  };
  return d;
}

}  // namespace ambrig
