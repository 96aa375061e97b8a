#include "rotor/motion/rotor_model.h"

#include <algorithm>
#include <cmath>

#include "core/base/index.h"

namespace ambrig {

RotorModel::RotorModel(const RotorParameters& parameters, const std::array<double, 3>& gravity)
    : p_(parameters),
      g_(gravity),
      shaft_(parameters.inertia_transverse, parameters.inertia_polar) {}

int RotorModel::NewDof(double mass) {
  if (dof_ >= kMaxDof) throw InputError("too many moving parts in one rig (modes, mounts, races)");
  inverse_mass_[AsSize(dof_)] = 1 / mass;
  return dof_++;
}

void RotorModel::AddBendingMode(const BendingMode& mode) {
  if (shaft_.modes().size() >= kMaxModes)
    throw InputError("too many bending modes in one rig, allowed: " + std::to_string(kMaxModes));
  const int dof = NewDof(1);
  NewDof(1);
  shaft_.Add(mode, dof);
}

PlaneMap RotorModel::MakePlane(double z) const {
  PlaneMap map;
  map.z = z;
  map.Add(0, 1, 0);
  map.Add(1, 0, 1);
  map.Add(4, z, 0);
  map.Add(3, 0, -z);
  shaft_.AddTo(map);
  return map;
}

void RotorModel::AddAuxiliary(const std::string& name, double z, const AuxiliaryParameters& p) {
  AuxiliaryPlane plane;
  plane.name = name;
  plane.map = MakePlane(z);
  plane.parameters = p;
  if (std::isfinite(p.mount_stiffness)) {
    plane.mount_dof = NewDof(p.mount_mass);
    NewDof(p.mount_mass);
  }
  if (p.race_inertia > 0) plane.race_dof = NewDof(p.race_inertia);
  aux_.push_back(plane);
}

void RotorModel::SetMount(std::size_t k, double stiffness, double damping, double mass) {
  AuxiliaryPlane& plane = aux_[k];
  plane.parameters.mount_stiffness = stiffness;
  plane.parameters.mount_damping = damping;
  plane.parameters.mount_mass = mass;
  if (plane.mount_dof < 0) {
    plane.mount_dof = NewDof(mass);
    NewDof(mass);
  }
  inverse_mass_[AsSize(plane.mount_dof)] = inverse_mass_[AsSize(plane.mount_dof) + 1] = 1 / mass;
}

void RotorModel::SetBase(const BaseOnFloor& base) {
  base_ = base;
  base_dof_ = NewDof(base.mass);
  NewDof(base.mass);
}

void RotorModel::AddLoad(double z, double fx, double fy, double fz, double start, double stop) {
  loads_.push_back({MakePlane(z), fx, fy, fz, start, stop});
}

void RotorModel::SetSpeed(const SpeedProfile& profile, double free_from) {
  speed_ = profile;
  free_from_ = free_from;
}

void RotorModel::Rest(MotionState& s) const {
  if (aux_.size() < 2) throw InputError("a resting start needs two auxiliary bearings");
  const double g = std::hypot(g_[0], g_[1]);
  if (g == 0) throw InputError("a resting start needs gravity across the shaft");
  const double z0 = aux_[0].map.z, z1 = aux_[1].map.z;
  const double nx = g_[0] / g, ny = g_[1] / g;
  const double load[2] = {p_.mass * g * z1 / (z1 - z0), -p_.mass * g * z0 / (z1 - z0)};
  double depth[2];
  for (std::size_t m = 0; m < modes().size(); ++m) {  // the shaft sags between what carries it
    const std::size_t d = AsSize(mode_dof(m));
    const double push = -modes()[m].Gain(z0) * load[0] - modes()[m].Gain(z1) * load[1];
    const double sag = push / (modes()[m].omega * modes()[m].omega);
    s.q[d] = nx * sag;
    s.q[d + 1] = ny * sag;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const AuxiliaryPlane& aux = aux_[k];
    depth[k] = aux.parameters.clearance + StaticPenetration(aux.parameters, load[k]);
    // bent part: the rigid one is still zero
    depth[k] -= nx * aux.map.X(s.q) + ny * aux.map.Y(s.q);
    if (aux.mount_dof < 0) continue;
    const double sag = load[k] / aux.parameters.mount_stiffness;
    s.q[AsSize(aux.mount_dof)] = nx * sag;
    s.q[AsSize(aux.mount_dof) + 1] = ny * sag;
    depth[k] += sag;
  }
  const double slope = (depth[1] - depth[0]) / (z1 - z0), centre = depth[0] - slope * z0;
  s.q[0] = nx * centre;
  s.q[1] = ny * centre;
  s.q[4] = nx * slope;
  s.q[3] = -ny * slope;
  if (axial_free && has_axial_ && g_[2] != 0) {
    const double side = g_[2] < 0 ? -1 : 1;
    s.q[2] = side * (axial_.clearance + StaticPenetration(axial_, p_.mass * std::abs(g_[2])));
  }
  SettleBase(s, -p_.mass * g_[0], -p_.mass * g_[1]);
}

void RotorModel::SettleBase(MotionState& s, double stator_x, double stator_y) const {
  if (base_dof_ < 0) return;
  s.q[AsSize(base_dof_)] = -stator_x / base_.stiffness[0];
  s.q[AsSize(base_dof_) + 1] = -stator_y / base_.stiffness[1];
}

double RotorModel::Energy(const MotionState& s) const {
  double e = 0.5 * p_.mass * (s.v[0] * s.v[0] + s.v[1] * s.v[1] + s.v[2] * s.v[2]) +
             0.5 * p_.inertia_transverse * (s.v[3] * s.v[3] + s.v[4] * s.v[4]) +
             0.5 * p_.inertia_polar * s.Omega * s.Omega;
  for (std::size_t d = 0; d < 3; ++d) e -= p_.mass * g_[d] * s.q[d];
  for (std::size_t k = 0; k < aux_.size(); ++k) {
    const double depth = Penetration(s, k);
    const AuxiliaryParameters& p = aux_[k].parameters;
    if (depth > 0) e += p.stiffness * std::pow(depth, p.exponent + 1) / (p.exponent + 1);
  }
  return e + shaft_.Energy(s);
}

}  // namespace ambrig
