/// A bent shaft: the surface at z runs off the mass axis by
///   b(z) = (c, s) u + (c2, s2) u² + (c3, s3) u³,  u = z/z_ref,
///   z_ref the largest |z| of the radial bearing planes,
/// turned by theta, whatever the speed. It moves gaps, journals and readings; the mass axis itself
/// is the model's coordinate, so at equal b everywhere a bow would be an unbalance: hence the shape
/// vanishes at the centre of mass. With c2 and c3 it is unequal at the ends, or an S. Size 1 to
/// 30 um (published_values.md 7).
#include <algorithm>
#include <array>
#include <cmath>

#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

class Bow : public SurfaceTerm {
 public:
  using Powers = std::array<double, 3>;  // of u [m]
  Bow(const Powers& c, const Powers& s, double reference) : c_(c), s_(s), reference_(reference) {}
  void Add(const MotionState& state, double z, double* dx, double* dy) const override {
    const double u = z / reference_;
    const auto at = [u](const Powers& p) { return u * (p[0] + u * (p[1] + u * p[2])); };
    const Turned b = turning_.At(at(c_), at(s_), state.theta);
    *dx += b.x;
    *dy += b.y;
  }

 private:
  Powers c_, s_;
  double reference_;  // [m]
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
  const auto shape = [](const char* name, double usual, const char* what) {
    return EffectParameter{name, "m", 0, -1e-3, 1e-3, 1e-6, usual, what};
  };
  d.parameters = {
      shape("c", 3e-5, "along the mark, at z = + the largest |z| of the bearing planes"),
      shape("s", 3e-5, "90 degrees ahead of the mark"),
      shape("c2", 1e-5, "part that is equal at both ends and grows with z squared"),
      shape("s2", 1e-5, "90 degrees ahead of the mark"),
      shape("c3", 1e-5, "part that is opposite at the ends and grows with z cubed"),
      shape("s3", 1e-5, "90 degrees ahead of the mark")};
  d.off_when_null = {"c", "s", "c2", "s2", "c3", "s3"};
  d.shows_in = "slow-roll and turning records: once per turn, other at the two planes";
  d.confused_with =
      "sensor-runout (one plane, gaps unmoved), unbalance (grows with the square of the speed)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    double reference = 0;
    for (const auto& [name, z] : plant.planes) reference = std::max(reference, std::abs(z));
    if (reference == 0) reference = 1;  // planes at the centre of mass see no bow
    plant.rotor.surface.push_back(
        std::make_unique<Bow>(Bow::Powers{e.Value("c"), e.Value("c2"), e.Value("c3")},
                              Bow::Powers{e.Value("s"), e.Value("s2"), e.Value("s3")}, reference));
  };
  return d;
}

}  // namespace ambrig
