/// Iron in series with each gap: R = (g + path)/(mu0 A), path = l_fe/mu_r.
///
/// Force still is phi²/(2 mu0 A) per pole, so current and position stiffness both fall while
/// ki/ks = (g0 + path)/i0 grows (published_values.md 7). Limit: linear iron; see saturation.
#include "effects/coil_targets.h"
#include "effects/effect.h"

namespace ambrig {

EffectDescription IronReluctance() {
  EffectDescription d;
  d.id = "iron-reluctance";
  d.title = "Reluctance of the iron path";
  d.physics =
      "The flux needs MMF for the iron too, not only for the gap: every gap acts as if it were "
      "longer\n"
      "by l_fe/mu_r, while the pull per flux stays the same.";
  d.target = TargetKind::kBearing;
  d.parameters = {{"path", "m", 0, 0, 1e-3, 5e-6, 5e-5, "iron length over mu_r, per gap"}};
  d.off_when_null = {"path"};
  d.shows_in =
      "clamped current steps and ramps: less force and less inductance at every rotor position";
  d.confused_with = "a larger gap (whose force falls faster with position), fewer turns, fringing";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    TargetBearing(e, plant).lanes.reluctance.iron_path = e.Value("path");
  };
  return d;
}

}  // namespace ambrig
