/// What acts on the bodies of an OdeRotor in one step: forces, mounts, contacts; and how long a
/// step may be.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rotor/crosscheck/ode_rotor_rig.h"

namespace ambrig {

namespace {

using Eigen::Vector3d;

constexpr double kContactPhase = 0.02;  // [rad] ω h of a contact, at most
constexpr double kMountPhase = 0.05;    // [rad] of a mount
constexpr double kLeastDamping = 1e-3;  // of h dF/dp: a law without damping has b = 0, CFM = ∞

}  // namespace

void OdeRotor::Rig::AddForces(const MotionState& s, const DofVector& Q, const Vector3d& stator,
                              double h) {
  RotorForces f;
  f.Q = Q;
  for (const auto& term : model_.terms) term->Add(s, f);
  for (const ExternalLoad& load : model_.loads()) {
    const double from = std::max(load.start, s.t), to = std::min(load.stop, s.t + h);
    if (to <= from) continue;  // else its mean over the step
    const double share = (to - from) / h;
    load.map.AddForce(share * load.fx, share * load.fy, f.Q);
    f.Q[2] += share * load.fz;
  }
  const Vector3d floor(f.base_ax, f.base_ay, 0);  // bodies are seen from the floor
  const auto& g = model_.gravity();
  Vector3d force = Vector3d(f.Q[0], f.Q[1], f.Q[2]) +
                   model_.parameters().mass * (Vector3d(g[0], g[1], g[2]) - floor);
  if (!model_.axial_free) force.z() = 0;
  world_.AddForce(rotor_, force);
  world_.AddTorque(rotor_, Vector3d(f.Q[3], f.Q[4], 0) + f.torque * Axis());
  if (base_ >= 0) {
    const BaseOnFloor& b = model_.base();
    const Vector3d push = stator + Vector3d(f.stator_x, f.stator_y, 0);
    world_.AddForce(
        base_, -Eigen::Vector3d(b.stiffness[0], b.stiffness[1], 0).cwiseProduct(BasePlace()) -
                   Eigen::Vector3d(b.damping[0], b.damping[1], 0).cwiseProduct(BaseVelocity()) -
                   push - b.mass * floor);
  }
  AddMounts(floor);
}

void OdeRotor::Rig::AddMounts(const Vector3d& floor) {
  for (const Race& race : races_) {
    const AuxiliaryParameters& p = race.plane->parameters;
    if (race.turns)
      world_.AddTorque(race.body, -p.race_drag * world_.Turning(race.body).z() * Vector3d::UnitZ());
    if (!race.on_mount) continue;
    Vector3d out = world_.Place(race.body) - BasePlace();
    out.z() = 0;
    const Vector3d f =
        -p.mount_stiffness * out - p.mount_damping * (world_.Velocity(race.body) - BaseVelocity());
    world_.AddForce(race.body, f - p.mount_mass * floor);
    if (base_ >= 0) world_.AddForce(base_, -f);
  }
}

bool OdeRotor::Rig::AddContacts(const MotionState& s, double h) {
  const double radius = model_.parameters().journal_radius;
  const Vector3d e = Axis(), x = world_.Place(rotor_);
  bool any = false;
  for (const Race& race : races_) {
    const double z = race.plane->map.z;
    double bow_x = 0, bow_y = 0;
    for (const auto& term : model_.surface) term->Add(s, z, &bow_x, &bow_y);
    const Vector3d centre =
        race.on_mount || race.turns ? world_.Place(race.body) : Vector3d(BasePlace());
    const Vector3d journal = x + z * e + Vector3d(bow_x, bow_y, 0);
    const double rx = journal.x() - centre.x(), ry = journal.y() - centre.y();
    const double r = std::hypot(rx, ry);
    OdeContact c;
    c.depth = r - race.plane->parameters.clearance;
    if (c.depth <= 0) continue;
    const Vector3d out(rx / r, ry / r, 0);
    c.one = rotor_;
    c.two = race.body;
    c.point = journal + radius * out;
    c.normal = -out;
    c.slide = Vector3d(-out.y(), out.x(), 0);
    c.friction = race.plane->parameters.friction;
    AddContact(race.plane->parameters, c, h);
    any = true;
  }
  const AuxiliaryParameters* stop = model_.axial_free ? model_.axial_stop() : nullptr;
  if (stop == nullptr || std::abs(x.z()) <= stop->clearance) return any;
  OdeContact c;
  const double side = x.z() < 0 ? -1 : 1;
  c.one = rotor_;
  c.point = x;  // on the axis: a stop takes no moment
  c.normal = Vector3d(0, 0, -side);
  c.slide = Vector3d::UnitX();
  c.depth = std::abs(x.z()) - stop->clearance;
  AddContact(*stop, c, h);
  return true;
}

void OdeRotor::Rig::AddContact(const AuxiliaryParameters& p, OdeContact c, double h) {
  const double force = p.stiffness * std::pow(c.depth, p.exponent);
  const double rate = p.exponent * force / c.depth;  // dF/dp
  const double b = std::max(force * p.damping, kLeastDamping * h * rate);
  c.cfm = 1 / b;
  c.erp = h * force / (b * c.depth);
  world_.AddContact(c);
}

double OdeRotor::Rig::LongestStep(const MotionState& s, double dt) const {
  if (const double mount = model_.MountRate(); !model_.NearContact(s, 2 * dt))
    return mount > 0 ? std::min(options_.far_step, kMountPhase / mount) : options_.far_step;
  double longest = options_.step;
  if (const double mount = model_.MountRate(); mount > 0)
    longest = std::min(longest, kMountPhase / mount);
  for (std::size_t k = 0; k < model_.auxiliaries().size(); ++k) {
    const AuxiliaryPlane& plane = model_.auxiliaries()[k];
    const AuxiliaryParameters& p = plane.parameters;
    const double depth = std::max(model_.Penetration(s, k), 1e-6);
    double mobility = 1 / model_.parameters().mass + plane.map.z * plane.map.z / It_;
    if (plane.mount_dof >= 0) mobility += 1 / p.mount_mass;
    const double rate = p.exponent * p.stiffness * std::pow(depth, p.exponent - 1);
    longest = std::min(longest, kContactPhase / std::sqrt(rate * mobility));
    // b/m, the rate of the law's damping: 1/s to 1e3/s in a drop, 4e5/s in a whirl of 60 mm.
    const double force =
        model_.Penetration(s, k) > 0 ? p.stiffness * std::pow(depth, p.exponent) : 0;
    longest = std::min(longest, kContactPhase / std::max(p.damping * force * mobility, 1.0));
  }
  if (const AuxiliaryParameters* stop = model_.axial_free ? model_.axial_stop() : nullptr)
    longest =
        std::min(longest, kContactPhase * std::sqrt(model_.parameters().mass / stop->stiffness));
  return longest;
}

}  // namespace ambrig
