#include "simulation/sampled/start_state.h"

#include <cmath>

#include "core/math/constants.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

void HoldSetPoints(const NominalRig& nominal, std::vector<BearingControl>& control) {
  for (std::size_t k = 0; k < control.size(); ++k) {
    const double resistance = CoilResistance(nominal->bearings[k]);
    for (int j = 0; j < control[k].coils; ++j)
      control[k].regulator[static_cast<std::size_t>(j)].HoldCurrent(control[k].set_point[j],
                                                                    resistance);
  }
}

PlanePoint StartWithForces(const NominalRig& nominal, const std::vector<double>& force,
                           std::vector<BearingControl>& control) {
  PlanePoint sum;
  std::size_t axis = 0;
  for (std::size_t k = 0; k < control.size(); ++k) {
    const bool planar = nominal->bearings[k].Axes().size() > 1;
    const double f[2] = {force[axis], planar ? force[axis + 1] : 0};
    axis += planar ? 2 : 1;
    BearingControl& c = control[k];
    const auto set = c.map.SetPoints(f[0], f[1]);
    for (int j = 0; j < c.coils; ++j) c.set_point[j] = set[j];
    if (!planar) continue;
    sum.x += f[0];
    sum.y += f[1];
  }
  HoldSetPoints(nominal, control);
  return sum;
}

void SwitchOn(std::vector<BearingControl>& control) {
  for (BearingControl& c : control) {
    c.set_point = Lane{};
    for (CurrentRegulator& a : c.regulator) a.ResetToLowerLimit();
  }
}

void PlaceClamped(const TrueRig& rig, const Scenario& scenario, MotionState& s) {
  double n = 0, sz = 0, szz = 0, sx = 0, sy = 0, szx = 0, szy = 0;
  for (const BearingParameters& b : rig->bearings) {
    const auto it = scenario.clamp.find(b.name);
    const std::array<double, 2> at =
        it == scenario.clamp.end() ? std::array<double, 2>{0, 0} : it->second;
    if (!b.kind->two_axes) {
      const std::array<double, 3> axis = b.kind->axis(b);
      for (std::size_t c = 0; c < 3; ++c)
        if (axis[c] != 0) s.q[c] = at[0] * axis[c];
    } else {
      n += 1;
      sz += b.z;
      szz += b.z * b.z;
      sx += at[0];
      sy += at[1];
      szx += b.z * at[0];
      szy += b.z * at[1];
    }
  }
  if (n < 2) return;
  const double det = n * szz - sz * sz;
  s.q[0] = (szz * sx - sz * szx) / det;
  s.q[1] = (szz * sy - sz * szy) / det;
  s.q[4] = (n * szx - sz * sx) / det;
  s.q[3] = -(n * szy - sz * sy) / det;
}

}  // namespace ambrig
