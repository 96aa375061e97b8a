#include "simulation/sampled/start_state.h"

#include <cmath>

#include "core/math/constants.h"
#include "rig/rig_assembly.h"

namespace ambrig {

BearingControl MakeBearingControl(const RigParameters& rig, const RigParameters& nominal,
                                  std::size_t k, const StatorLanes& lanes) {
  const BearingParameters& p = rig.bearings[k];
  BearingControl c;
  c.name = p.name;
  c.coils = p.coils();
  c.amplifier.fill(PowerAmplifier(rig.amplifier));
  c.map.k = ForceConstant(nominal.bearings[k]);
  c.map.c0 = BiasCurrent(rig, p);
  c.map.i_max = rig.amplifier.i_max;
  c.map.unipolar = rig.amplifier.quadrants < 3;
  for (int j = 0; j < c.coils; ++j) c.map.W.row(j) << 1, lanes.direction_x[j], lanes.direction_y[j];
  return c;
}

void HoldSetPoints(BearingControl& control, const Lane& resistance) {
  for (int j = 0; j < control.coils; ++j)
    control.amplifier[static_cast<std::size_t>(j)].HoldCurrent(control.set_point[j], resistance[j]);
}

void StartWithForces(const RigParameters& rig, const std::vector<double>& force, const Plant& plant,
                     std::vector<BearingControl>& control, MotionState& s) {
  double fx = 0, fy = 0;
  std::size_t axis = 0;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const bool planar = rig.bearings[k].Axes().size() > 1;
    const double f[2] = {force[axis], planar ? force[axis + 1] : 0};
    axis += planar ? 2 : 1;
    BearingControl& c = control[k];
    const auto set = c.map.SetPoints(f[0], f[1]);
    for (int j = 0; j < c.coils; ++j) c.set_point[j] = set[j];
    HoldSetPoints(c, plant.bearings[k].base_resistance);
    if (!planar) continue;
    fx += f[0];
    fy += f[1];
  }
  plant.rotor.SettleBase(s, fx, fy);
}

void SwitchOn(std::vector<BearingControl>& control) {
  for (BearingControl& c : control) {
    c.set_point = Lane{};
    for (PowerAmplifier& a : c.amplifier) a.ResetToLowerLimit();
  }
}

void PlaceClamped(const RigParameters& rig, const Scenario& scenario, MotionState& s) {
  double n = 0, sz = 0, szz = 0, sx = 0, sy = 0, szx = 0, szy = 0;
  for (const BearingParameters& b : rig.bearings) {
    const auto it = scenario.clamp.find(b.name);
    const std::array<double, 2> at =
        it == scenario.clamp.end() ? std::array<double, 2>{0, 0} : it->second;
    if (b.kind == BearingKind::kThrust) {
      s.q[2] = at[0];
    } else if (b.kind == BearingKind::kOpposed) {
      const double angle = b.opposed.angle_deg * kPi / 180;
      s.q[0] = at[0] * std::cos(angle);
      s.q[1] = at[0] * std::sin(angle);
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
