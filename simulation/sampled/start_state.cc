#include "simulation/sampled/start_state.h"

#include <cmath>

#include "core/math/line_weights.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

void HoldSetPoints(const NominalRig& nominal, std::vector<BearingControl>& control) {
  for (std::size_t k = 0; k < control.size(); ++k) {
    const double resistance = CoilResistance(nominal->bearings[k]);
    for (int j = 0; j < control[k].coils; ++j)
      control[k].regulator.HoldCurrent(static_cast<std::size_t>(j), control[k].set_point[j],
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
    c.regulator.ResetToLowerLimit();
  }
}

void PlaceClamped(const TrueRig& rig, const Scenario& scenario, MotionState& s) {
  std::vector<double> places;
  std::vector<std::array<double, 2>> centres;
  for (const BearingParameters& b : rig->bearings) {
    const auto it = scenario.clamp.find(b.name);
    const std::array<double, 2> at =
        it == scenario.clamp.end() ? std::array<double, 2>{0, 0} : it->second;
    if (!b.kind->two_axes) {
      const std::array<double, 3> axis = b.kind->axis(b);
      for (std::size_t c = 0; c < 3; ++c)
        if (axis[c] != 0) s.q[c] = at[0] * axis[c];
    } else {
      places.push_back(b.z);
      centres.push_back(at);
    }
  }
  if (places.size() < 2) return;
  // The line through the centres: its height at the centre of mass, and its slope.
  const std::vector<double> here = LineWeights(places, 0), ahead = LineWeights(places, 1);
  s.q[0] = s.q[1] = s.q[3] = s.q[4] = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    s.q[0] += here[k] * centres[k][0];
    s.q[1] += here[k] * centres[k][1];
    s.q[4] += (ahead[k] - here[k]) * centres[k][0];
    s.q[3] -= (ahead[k] - here[k]) * centres[k][1];
  }
}

}  // namespace ambrig
