/// The stator stands on a compliant base: mass M on a spring and damper in both radial directions,
///   M X'' + c X' + k X = -(force of the stator on the rotor),  k = M (2 pi f)²,  c = 2 zeta M 2 pi
///   f, along y with the frequency f times `ratio`: foundations are as a rule stiffer one way.
/// Sensors and gaps move with the base. From force to relative motion this puts a pole at f and a
/// zero at f √(M/(M + m)) of a rigid rotor, without gyroscopic split
/// (docs/theory/published_values.md 7).
#include "core/math/constants.h"
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

EffectDescription BaseMode() {
  EffectDescription d;
  d.id = "base-mode";
  d.title = "Compliant base";
  d.physics =
      "The stator is not fixed: it moves on its base as a mass on a spring under the "
      "reaction\nforces of the bearings. A pole and a zero appear near its frequency in every "
      "radial axis.";
  d.target = TargetKind::kRig;
  d.needs.levitation = true;
  d.parameters = {
      {"mass", "kg", kInfinity, 1e-2, kInfinity, 10, 500, "moving mass of stator and base"},
      {"frequency", "Hz", 60, 0.5, 2e3, 20, 200, "of stator on base along x, rotor clamped off"},
      {"damping", "-", 0.02, 0, 2, 0.005, 0.1, "ratio"},
      {"ratio", "-", 1, 0.2, 5, 0.8, 1.25, "of the frequency along y to that along x"}};
  d.off_when_null = {"mass"};
  d.shows_in = "force excitation near its frequency; the planes answer together, at standstill too";
  d.confused_with = "bending-mode (splits with speed, other signs along z), base-vibration";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    if (plant.rotor.HasBase()) throw InputError(e.where + ": a rig has one base-mode");
    BaseOnFloor base{e.Value("mass")};
    for (std::size_t side = 0; side < 2; ++side) {
      const double w = 2 * kPi * e.Value("frequency") * (side == 0 ? 1 : e.Value("ratio"));
      base.stiffness[side] = base.mass * w * w;
      base.damping[side] = 2 * e.Value("damping") * base.mass * w;
    }
    plant.rotor.SetBase(base);
  };
  return d;
}

}  // namespace ambrig
