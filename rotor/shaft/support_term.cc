#include "rotor/shaft/support_term.h"

#include <cmath>

namespace ambrig {

SupportTerm::SupportTerm(const PlaneMap& plane, const SpringSupport& support)
    : plane_(plane), support_(support) {
  Require(support.on_shaft() && support.on.empty() && !support.has_mass(),
          "a support to ground without added masses");
}

void SupportTerm::Add(const MotionState& s, RotorForces& forces) const {
  const SupportCoefficients c = support_.At(std::abs(s.Omega));
  const auto [x, y] = plane_.Point(s.q);
  const auto [vx, vy] = plane_.Point(s.v);
  const double fx = -(c.kxx * x + c.kxy * y + c.cxx * vx + c.cxy * vy),
               fy = -(c.kyx * x + c.kyy * y + c.cyx * vx + c.cyy * vy);
  plane_.AddForce(fx, fy, forces.Q);
  forces.Q[2] -= c.kzz * s.q[2] + c.czz * s.v[2];
  forces.stator_x += fx;
  forces.stator_y += fy;
}

}  // namespace ambrig
