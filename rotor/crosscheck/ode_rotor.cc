#include "rotor/crosscheck/ode_rotor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/index.h"
#include "core/math/constants.h"
#include "rotor/crosscheck/ode_rotor_rig.h"

namespace ambrig {

namespace {

using Eigen::Vector3d;

constexpr double kLockedInertia = 1e9;  // [kg m2] bodies that are not to turn: base, still race
constexpr double kNoMass = 1e-4;        // [kg] a turning race without a mount belongs to the stator

Vector3d Radial(const DofVector& q, int d) { return {q[AsSize(d)], q[AsSize(d) + 1], 0}; }

/// The least rotation that brings the z axis to e, |e| = 1, e_z > 0: half the angle between them,
/// about their product.
Eigen::Quaterniond TiltOfZ(const Vector3d& e) {
  const double s = std::sqrt((1 + e.z()) * 2);
  const double inverse = 1 / s;
  return {s * 0.5, -e.y() * inverse, e.x() * inverse, 0};
}

}  // namespace

OdeRotor::Rig::Rig(const RotorModel& model, const OdeOptions& options)
    : model_(model),
      options_(options),
      Ip_(model.parameters().inertia_polar),
      It_(model.parameters().inertia_transverse) {
  if (!model.modes().empty())
    throw InputError("the ODE rotor is rigid: allowed: rigs without bending modes");
  if (!(Ip_ > 0)) throw InputError("the ODE rotor needs rotor.inertia_polar > 0");
  rotor_ = world_.AddBody(model.parameters().mass, {It_, It_, Ip_}, options.native_gyroscopics);
  if (model.HasBase())
    base_ = world_.AddBody(model.base().mass, Vector3d::Constant(kLockedInertia), false);
  for (const AuxiliaryPlane& plane : model.auxiliaries()) {
    Race race{&plane, base_, plane.mount_dof >= 0, plane.race_dof >= 0};
    const AuxiliaryParameters& p = plane.parameters;
    if (race.on_mount || race.turns) {
      const double turning = race.turns ? p.race_inertia : kLockedInertia;
      const double mass = race.on_mount ? p.mount_mass : kNoMass;
      race.body = world_.AddBody(mass, {kLockedInertia, kLockedInertia, turning}, false);
    }
    if (race.body != base_)
      world_.SetPose(race.body, Vector3d(0, 0, plane.map.z), Eigen::Matrix3d::Identity());
    if (race.turns && !race.on_mount)
      world_.AddHinge(race.body, base_, Vector3d(0, 0, plane.map.z));
    races_.push_back(race);
  }
}

void OdeRotor::Rig::Load(const MotionState& s) {
  // The axis through (x + z beta, y - z alpha) for every z, and its rate.
  const Vector3d u(s.q[4], -s.q[3], 1), du(s.v[4], -s.v[3], 0);
  const Vector3d e = u.normalized(), de = (du - e * e.dot(du)) / u.norm();
  const int d = model_.base_dof();
  const Vector3d base = d < 0 ? Vector3d::Zero() : Radial(s.q, d);
  const Vector3d base_v = d < 0 ? Vector3d::Zero() : Radial(s.v, d);
  const Eigen::Quaterniond tilt = TiltOfZ(e.normalized());  // once more: of rounding
  const Eigen::AngleAxisd spin(std::remainder(s.theta, 2 * kPi), Vector3d::UnitZ());
  world_.SetPose(rotor_, base + Vector3d(s.q[0], s.q[1], s.q[2]), (tilt * spin).toRotationMatrix());
  world_.SetVelocity(rotor_, base_v + Vector3d(s.v[0], s.v[1], s.v[2]));
  world_.SetTurning(rotor_, e.cross(de) + s.Omega * e);
  if (base_ >= 0) {
    world_.SetPose(base_, base, Eigen::Matrix3d::Identity());
    world_.SetVelocity(base_, base_v);
  }
  for (const Race& race : races_) {
    if (!race.on_mount && !race.turns) continue;
    const int m = race.plane->mount_dof;
    const Vector3d out = m < 0 ? Vector3d::Zero() : Radial(s.q, m);
    const Vector3d out_v = m < 0 ? Vector3d::Zero() : Radial(s.v, m);
    world_.SetPose(race.body, base + out + Vector3d(0, 0, race.plane->map.z),
                   Eigen::Matrix3d::Identity());
    world_.SetVelocity(race.body, base_v + out_v);
    const double turning = race.turns ? s.v[AsSize(race.plane->race_dof)] : 0;
    world_.SetTurning(race.body, Vector3d(0, 0, turning));
  }
}

void OdeRotor::Rig::Store(MotionState& s, double h) const {
  const Vector3d base = BasePlace(), base_v = BaseVelocity();
  const Vector3d x = world_.Place(rotor_) - base, v = world_.Velocity(rotor_) - base_v;
  const Vector3d omega = world_.Turning(rotor_), e = Axis(), de = omega.cross(e);
  for (int k = 0; k < 3; ++k) {
    s.q[AsSize(k)] = x[k];
    s.v[AsSize(k)] = v[k];
  }
  const Vector3d u = e / e.z(), du = de / e.z() - e * de.z() / (e.z() * e.z());
  s.q[3] = -u.y();
  s.q[4] = u.x();
  s.v[3] = -du.y();
  s.v[4] = du.x();
  const auto put = [&](int d, const Vector3d& place, const Vector3d& velocity) {
    for (int k = 0; k < 2; ++k) {
      s.q[AsSize(d + k)] = place[k];
      s.v[AsSize(d + k)] = velocity[k];
    }
  };
  if (base_ >= 0) put(model_.base_dof(), base, base_v);
  for (const Race& race : races_) {
    if (race.on_mount)
      put(race.plane->mount_dof, world_.Place(race.body) - base,
          world_.Velocity(race.body) - base_v);
    if (!race.turns) continue;
    const std::size_t d = AsSize(race.plane->race_dof);
    s.v[d] = world_.Turning(race.body).z();
    s.q[d] += h * s.v[d];
  }
}

void OdeRotor::Rig::TurnAndStep(MotionState& s, bool contact, double h) {
  const auto omega_of = [this](const Vector3d& L, const Vector3d& e) -> Vector3d {
    const Vector3d along = e.dot(L) * e;
    return (L - along) / It_ + along / Ip_;
  };
  const auto momentum_of = [this](const Vector3d& omega, const Vector3d& e) -> Vector3d {
    const Vector3d along = e.dot(omega) * e;
    return It_ * (omega - along) + Ip_ * along;
  };
  const bool free = model_.SpeedIsFree(s.t);
  const double after = free ? 0 : model_.speed().Speed(s.t + h);
  Vector3d e = Axis(), omega = world_.Turning(rotor_);
  if (!options_.native_gyroscopics) {
    const Vector3d L = momentum_of(omega, e);
    e = (e + h / 2 * omega.cross(e)).normalized();
    omega = omega_of(L, e);
    if (!free) omega += (after - omega.dot(e)) * e;
    world_.SetTurning(rotor_, omega);
  }
  // Without contact nothing but L acts on the spin; with one the motor must be in the same LCP.
  if (contact && !free) world_.AddMotor(rotor_, e, after);
  world_.Step(h);
  ++steps;
  const Vector3d end = Axis();
  omega = world_.Turning(rotor_);
  if (!options_.native_gyroscopics) omega = omega_of(momentum_of(omega, e), end);
  if (!free) omega += (after - omega.dot(end)) * end;
  world_.SetTurning(rotor_, omega);
  s.t += h;
  if (free) {
    const double Omega = omega.dot(end);
    s.Omega_dot = (Omega - s.Omega) / h;
    s.theta += h / 2 * (s.Omega + Omega);
    s.Omega = Omega;
  } else {
    model_.SetSpin(s);
  }
}

void OdeRotor::Rig::Step(MotionState& s, const DofVector& Q, const Vector3d& stator, double dt) {
  for (const DofVector* part : std::initializer_list<const DofVector*>{&s.q, &s.v, &Q})
    for (double value : *part)
      if (!std::isfinite(value)) throw std::runtime_error("the ODE rotor got an infinite state");
  model_.SetSpin(s);
  Load(s);
  const int pieces =
      std::clamp(static_cast<int>(std::ceil(dt / LongestStep(s, dt) - 1e-9)), 1, 4000);
  const double h = dt / pieces, t0 = s.t;
  for (int k = 0; k < pieces; ++k) {
    AddForces(s, Q, stator, h);
    const bool contact = AddContacts(s, h);
    TurnAndStep(s, contact, h);
    Store(s, h);
    s.t = t0 + (k + 1) * h;
  }
  s.t = t0 + dt;
}

OdeRotor::OdeRotor(const RotorModel& model, const OdeOptions& options)
    : rig_(std::make_unique<Rig>(model, options)) {}

OdeRotor::~OdeRotor() = default;

void OdeRotor::Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
                    double dt) {
  rig_->Step(s, Q, Vector3d(stator_x, stator_y, 0), dt);
}

long OdeRotor::steps() const { return rig_->steps; }
long OdeRotor::warnings() const { return OdeWorld::Warnings() - rig_->first_warning; }

}  // namespace ambrig
