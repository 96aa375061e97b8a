/// The rotor in motion: accelerations, contact, Runge-Kutta steps fine enough for the fastest thing
/// that is touching, bending or ringing. One file, so that the compiler sees the hot path whole.
#include "rotor/motion/rotor_model.h"

#include <algorithm>
#include <cmath>

#include "core/base/index.h"

namespace ambrig {

namespace {
double Length(double x, double y) { return std::sqrt(x * x + y * y); }

// A step turns the fastest mode by this much: Runge-Kutta then errs by (wh)^4/120 = 8e-7 of its
// frequency and adds (wh)^5/144 = 7e-8 to its damping ratio.
constexpr double kModalAngle = 0.1;

/// Contact of the journal with one auxiliary bearing, and what its mount and its race do.
void AddContact(const AuxiliaryPlane& aux, double journal_radius, PlanePoint journal,
                const MotionState& s, RotorForces& f) {
  double x = journal.x, y = journal.y, vx = aux.map.X(s.v), vy = aux.map.Y(s.v);
  if (aux.mount_dof >= 0) {
    const std::size_t d = AsSize(aux.mount_dof);
    x -= s.q[d];
    y -= s.q[d + 1];
    vx -= s.v[d];
    vy -= s.v[d + 1];
  }
  const double race = aux.race_dof >= 0 ? s.v[AsSize(aux.race_dof)] : 0;
  const ContactForce c = RadialContact(aux.parameters, journal_radius, x, y, vx, vy, s.Omega, race);
  if (aux.mount_dof >= 0) {
    const std::size_t d = AsSize(aux.mount_dof);
    const AuxiliaryParameters& p = aux.parameters;
    const double mx = -p.mount_stiffness * s.q[d] - p.mount_damping * s.v[d];
    const double my = -p.mount_stiffness * s.q[d + 1] - p.mount_damping * s.v[d + 1];
    f.Q[d] += mx - c.fx;
    f.Q[d + 1] += my - c.fy;
    f.stator_x += mx;  // what the stator pushes, through the mount
    f.stator_y += my;
  } else {
    f.stator_x += c.fx;
    f.stator_y += c.fy;
  }
  if (aux.race_dof >= 0)
    f.Q[AsSize(aux.race_dof)] += c.race_torque - aux.parameters.race_drag * race;
  if (c.penetration <= 0) return;
  aux.map.AddForce(c.fx, c.fy, f.Q);
  f.torque += c.torque;
}

/// A base on springs, coordinates d and d + 1, relative to the floor, which may itself accelerate.
void AccelerateBase(const BaseOnFloor& base, std::size_t d, const MotionState& s,
                    const RotorForces& f, DofVector& a) {
  const double stator[2] = {f.stator_x, f.stator_y}, floor[2] = {f.base_ax, f.base_ay};
  for (std::size_t side = 0; side < 2; ++side)
    a[d + side] = (-base.stiffness[side] * s.q[d + side] - base.damping[side] * s.v[d + side] -
                   stator[side]) /
                      base.mass -
                  floor[side];
}

}  // namespace

void RotorModel::SetSpin(MotionState& s) const {
  if (!SpeedIsFree(s.t)) Prescribe(s);
}

void RotorModel::Prescribe(MotionState& s) const {
  const SpinState spin = speed_.At(s.t);
  s.theta = spin.angle;
  s.Omega = spin.speed;
  s.Omega_dot = spin.acceleration;
}

PlanePoint RotorModel::OnSurface(const MotionState& s, const PlaneMap& plane) const {
  PlanePoint p = plane.Point(s.q);
  double dx = 0, dy = 0;
  for (const auto& term : surface) term->Add(s, plane.z, &dx, &dy);
  for (std::size_t k = 0; k < static_cast<std::size_t>(plane.count); ++k) {
    // Seen as the plane sees a shift of the rotor: along one axis by an opposed pair, not by a
    // thrust bearing.
    if (plane.dof[k] > 1) continue;
    const double shift = plane.dof[k] == 0 ? dx : dy;
    p.x += plane.wx[k] * shift;
    p.y += plane.wy[k] * shift;
  }
  return p;
}

void RotorModel::Accelerations(const MotionState& s, const DofVector& Q, double stator_x,
                               double stator_y, DofVector& a, double* torque,
                               bool near_contact) const {
  RotorForces f(Q);
  f.stator_x = stator_x;
  f.stator_y = stator_y;
  for (const auto& term : terms) term->Add(s, f);
  for (const AuxiliaryPlane& aux : aux_)
    if (near_contact || aux.mount_dof >= 0 || aux.race_dof >= 0)
      AddContact(aux, p_.journal_radius, Position(s, aux.map), s, f);
  if (has_axial_ && axial_free) f.Q[2] += AxialContact(axial_, s.q[2], s.v[2]);
  shaft_.AddForces(s, f.Q);
  double ax = f.base_ax, ay = f.base_ay;
  if (base_dof_ >= 0) {
    const std::size_t d = AsSize(base_dof_);
    AccelerateBase(base_, d, s, f, a);
    ax += a[d];
    ay += a[d + 1];
  }
  a[0] = f.Q[0] / p_.mass + g_[0] - ax;
  a[1] = f.Q[1] / p_.mass + g_[1] - ay;
  a[2] = axial_free ? f.Q[2] / p_.mass + g_[2] : 0;
  a[3] = (f.Q[3] - p_.inertia_polar * s.Omega * s.v[4]) / p_.inertia_transverse;
  a[4] = (f.Q[4] + p_.inertia_polar * s.Omega * s.v[3]) / p_.inertia_transverse;
  for (int d = 5; d < dof_; ++d)
    if (base_dof_ < 0 || (d != base_dof_ && d != base_dof_ + 1))
      a[AsSize(d)] = f.Q[AsSize(d)] * inverse_mass_[AsSize(d)];
  for (const AuxiliaryPlane& aux : aux_) {  // mounts, too, are seen from the base
    if (aux.mount_dof < 0) continue;
    a[AsSize(aux.mount_dof)] -= ax;
    a[AsSize(aux.mount_dof) + 1] -= ay;
  }
  *torque = f.torque;
}

void RotorModel::StepOnce(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
                          double dt, bool near_contact) const {
  if (loads_.empty()) return StepUnder(s, Q, stator_x, stator_y, dt, near_contact);
  // Loads of the scenario enter with their mean over the step, so that their impulse is exact.
  DofVector forced = Q;
  for (const ExternalLoad& load : loads_) {
    const double from = std::max(load.start, s.t), to = std::min(load.stop, s.t + dt);
    if (to <= from) continue;
    const double share = (to - from) / dt;
    load.map.AddForce(share * load.fx, share * load.fy, forced);
    forced[2] += share * load.fz;
  }
  StepUnder(s, forced, stator_x, stator_y, dt, near_contact);
}

void RotorModel::StepUnder(MotionState& s, const DofVector& forced, double stator_x,
                           double stator_y, double dt, bool near_contact) const {
  if (IsUnforced(near_contact)) return StepUnforced(s, forced, dt);
  const bool free_spin = SpeedIsFree(s.t) && p_.inertia_polar > 0;
  MotionState stage = s;
  DofVector k_v[4], k_a[4];
  double k_w[4], stage_w[4];
  const double c[4] = {0, 0.5, 0.5, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    stage.t = s.t + c[k] * dt;
    if (k > 0)
      for (std::size_t d = 0; d < AsSize(dof_); ++d) {
        stage.q[d] = s.q[d] + c[k] * dt * k_v[k - 1][d];
        stage.v[d] = s.v[d] + c[k] * dt * k_a[k - 1][d];
      }
    if (free_spin && k > 0) {
      stage.Omega = s.Omega + c[k] * dt * k_w[k - 1];
      stage.theta = s.theta + c[k] * dt * stage_w[k - 1];
    } else if (!free_spin && k != 2) {  // the third stage is at the time of the second
      Prescribe(stage);
    }
    double torque = 0;
    Accelerations(stage, forced, stator_x, stator_y, k_a[k], &torque, near_contact);
    k_w[k] = free_spin ? torque / p_.inertia_polar : 0;
    stage_w[k] = stage.Omega;
    for (std::size_t d = 0; d < AsSize(dof_); ++d) k_v[k][d] = stage.v[d];
  }
  const double w = dt / 6;
  for (std::size_t d = 0; d < AsSize(dof_); ++d) {
    s.q[d] += w * (k_v[0][d] + 2 * (k_v[1][d] + k_v[2][d]) + k_v[3][d]);
    s.v[d] += w * (k_a[0][d] + 2 * (k_a[1][d] + k_a[2][d]) + k_a[3][d]);
  }
  s.t += dt;
  if (free_spin) {
    s.Omega_dot = k_w[0];
    s.theta += w * (stage_w[0] + 2 * (stage_w[1] + stage_w[2]) + stage_w[3]);
    s.Omega += w * (k_w[0] + 2 * (k_w[1] + k_w[2]) + k_w[3]);
  } else {
    // also where the speed is free from: a step that began before ends on the profile
    Prescribe(s);
  }
}

void RotorModel::StepUnforced(MotionState& s, const DofVector& forced, double dt) const {
  const bool free_spin = SpeedIsFree(s.t) && p_.inertia_polar > 0;
  const double half = 0.5 * dt, w = dt / 6;
  double a[5];
  for (std::size_t d = 0; d < 3; ++d) a[d] = forced[d] / p_.mass + g_[d];
  if (!axial_free) a[2] = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double middle = s.v[d] + half * a[d], end = s.v[d] + dt * a[d];
    s.q[d] += w * (s.v[d] + 2 * (middle + middle) + end);
    s.v[d] += w * (a[d] + 2 * (a[d] + a[d]) + a[d]);
  }
  const double start_speed = free_spin ? s.Omega : speed_.Speed(s.t);
  const double half_speed = free_spin ? s.Omega : speed_.Speed(s.t + half),
               end_speed = free_spin ? s.Omega : speed_.Speed(s.t + dt);
  const double spin[4] = {p_.inertia_polar * start_speed, p_.inertia_polar * half_speed,
                          p_.inertia_polar * half_speed, p_.inertia_polar * end_speed};
  const double ahead[4] = {0, half, half, dt}, tilt[2] = {s.v[3], s.v[4]};
  const double inverse_inertia = 1 / p_.inertia_transverse;
  double k_v[4][2], k_a[4][2];
  for (int k = 0; k < 4; ++k) {
    for (int c = 0; c < 2; ++c) k_v[k][c] = k > 0 ? tilt[c] + ahead[k] * k_a[k - 1][c] : tilt[c];
    k_a[k][0] = (forced[3] - spin[k] * k_v[k][1]) * inverse_inertia;
    k_a[k][1] = (forced[4] + spin[k] * k_v[k][0]) * inverse_inertia;
  }
  for (std::size_t c = 0; c < 2; ++c) {
    s.q[3 + c] += w * (k_v[0][c] + 2 * (k_v[1][c] + k_v[2][c]) + k_v[3][c]);
    s.v[3 + c] += w * (k_a[0][c] + 2 * (k_a[1][c] + k_a[2][c]) + k_a[3][c]);
  }
  s.t += dt;
  if (free_spin) {
    s.Omega_dot = 0;
    s.theta += w * (s.Omega + 2 * (s.Omega + s.Omega) + s.Omega);
  } else {
    Prescribe(s);
  }
}

double RotorModel::Penetration(const MotionState& s, std::size_t plane) const {
  const AuxiliaryPlane& aux = aux_[plane];
  auto [x, y] = Position(s, aux.map);
  if (aux.mount_dof >= 0) {
    x -= s.q[AsSize(aux.mount_dof)];
    y -= s.q[AsSize(aux.mount_dof) + 1];
  }
  return Length(x, y) - aux.parameters.clearance;
}

double RotorModel::AxialPenetration(const MotionState& s) const {
  return has_axial_ ? std::abs(s.q[2]) - axial_.clearance : -kInfinity;
}

bool RotorModel::FarFromContact(const MotionState& s, std::size_t plane, double horizon) const {
  if (!surface.empty() || aux_[plane].mount_dof >= 0) return false;
  const PlaneMap& m = aux_[plane].map;
  double reach = 0;  // no point moves further than the sum of what each coordinate moves it by
  if (m.of_rigid_rotor && m.count == 4) {
    const auto moves = [&](std::size_t d) { return std::abs(s.q[d]) + horizon * std::abs(s.v[d]); };
    reach = moves(0) + moves(1) + std::abs(m.z) * (moves(3) + moves(4));
    return reach < aux_[plane].parameters.clearance - 2e-7;
  }
  for (std::size_t k = 0; k < AsSize(m.count); ++k) {
    const std::size_t d = AsSize(m.dof[k]);
    reach +=
        (std::abs(m.wx[k]) + std::abs(m.wy[k])) * (std::abs(s.q[d]) + horizon * std::abs(s.v[d]));
  }
  return reach < aux_[plane].parameters.clearance - 2e-7;
}

bool RotorModel::NearContact(const MotionState& s, double horizon) const {
  for (std::size_t k = 0; k < aux_.size(); ++k) {
    const PlaneMap& m = aux_[k].map;
    if (FarFromContact(s, k, horizon)) continue;
    if (Penetration(s, k) + horizon * Length(m.X(s.v), m.Y(s.v)) > -1e-7) return true;
  }
  return has_axial_ && axial_free && AxialPenetration(s) + horizon * std::abs(s.v[2]) > -1e-7;
}

double RotorModel::MountRate() const {
  // Fastest rate [1/s] of a mount on its own: it rings on after the contact has ended.
  double rate = 0;
  for (const AuxiliaryPlane& aux : aux_) {
    if (aux.mount_dof < 0) continue;
    const AuxiliaryParameters& p = aux.parameters;
    rate = std::max(
        {rate, std::sqrt(p.mount_stiffness / p.mount_mass), p.mount_damping / p.mount_mass});
  }
  return rate;
}

void RotorModel::Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
                      double dt) const {
  const int modal =
      shaft_.empty() ? 1 : static_cast<int>(std::ceil(dt * shaft_.Rate(s.Omega) / kModalAngle));
  int pieces = std::clamp(std::max(static_cast<int>(std::ceil(dt * MountRate())), modal), 1, 400);
  const bool near = NearContact(s, 2 * dt);
  if (near) {
    // Fine enough that an impact is resolved to nanometres and no friction rate is unstable.
    pieces = std::clamp(std::max(static_cast<int>(std::ceil(dt * StiffnessRate(s) / 0.02)), modal),
                        4, 400);
  }
  const double h = dt / pieces, t0 = s.t;
  for (int k = 0; k < pieces; ++k) {
    StepOnce(s, Q, stator_x, stator_y, h, near);
    s.t = t0 + (k + 1) * h;
  }
  s.t = t0 + dt;
}

}  // namespace ambrig
