#include "rotor/contact/auxiliary_bearing.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {
double Normal(const AuxiliaryParameters& p, double penetration, double rate) {
  if (penetration <= 0) return 0;
  const double elastic = p.exponent == 1 ? penetration : std::pow(penetration, p.exponent);
  return std::max(0.0, p.stiffness * elastic * (1 + p.damping * rate));
}
}  // namespace

ContactForce RadialContact(const AuxiliaryParameters& p, double journal_radius, double x, double y,
                           double vx, double vy, double Omega, double race_speed) {
  ContactForce c;
  const double r = std::sqrt(x * x + y * y);
  c.penetration = r - p.clearance;
  if (c.penetration <= 0) return c;
  const double nx = x / r, ny = y / r;  // outward normal, tangent t = (-ny, nx)
  c.normal = Normal(p, c.penetration, vx * nx + vy * ny);
  const double slide = -vx * ny + vy * nx + (Omega - race_speed) * journal_radius;
  const double friction =
      -p.friction * c.normal * slide / std::sqrt(slide * slide + kSlidingSpeed * kSlidingSpeed);
  c.fx = -c.normal * nx - friction * ny;
  c.fy = -c.normal * ny + friction * nx;
  c.torque = friction * journal_radius;
  c.race_torque = -friction * journal_radius;
  return c;
}

double AxialContact(const AuxiliaryParameters& p, double z, double vz) {
  const double side = z < 0 ? -1 : 1;
  return -side * Normal(p, std::abs(z) - p.clearance, side * vz);
}

double StaticPenetration(const AuxiliaryParameters& p, double load) {
  return load <= 0 ? 0 : std::pow(load / p.stiffness, 1 / p.exponent);
}

}  // namespace ambrig
