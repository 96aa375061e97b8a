#include "rotor/motion/linearise.h"

namespace ambrig {
namespace {

using Eigen::Index;

/// What the force terms push at (q, v): generalised forces, and the stator's force on the rotor.
RotorForces TermForces(const RotorModel& model, const MotionState& s) {
  RotorForces f;
  for (const auto& term : model.terms) term->Add(s, f);
  return f;
}

Eigen::VectorXd OnCoordinates(const RotorModel& model, const RotorForces& f) {
  Eigen::VectorXd Q(model.dof());
  for (Index d = 0; d < Q.size(); ++d) Q(d) = f.Q[static_cast<std::size_t>(d)];
  if (const int d = model.base_dof(); d >= 0) {
    Q(d) -= f.stator_x;
    Q(d + 1) -= f.stator_y;
  }
  return Q;
}

/// Adds -dQ/dq to K and -dQ/dv to D: central differences, exact but for rounding where a term is
/// linear, which all but formulas are.
void AddTerms(const RotorModel& model, double speed, LinearRotor& out) {
  constexpr double kStep[2] = {1e-7, 1e-5};  // [m], [m/s]: far inside a gap
  for (int d = 0; d < model.dof(); ++d)
    for (int rate = 0; rate < 2; ++rate) {
      Eigen::VectorXd side[2];
      for (int k = 0; k < 2; ++k) {
        MotionState s;
        s.Omega = speed;
        (rate ? s.v : s.q)[static_cast<std::size_t>(d)] = k ? kStep[rate] : -kStep[rate];
        side[k] = OnCoordinates(model, TermForces(model, s));
      }
      (rate ? out.D : out.K).col(d) -= (side[1] - side[0]) / (2 * kStep[rate]);
    }
}

void AddModes(const RotorModel& model, LinearRotor& out) {
  for (std::size_t k = 0; k < model.modes().size(); ++k) {
    const BendingMode& mode = model.modes()[k];
    const Index d = model.mode_dof(k);
    for (Index i : {d, d + 1}) {
      out.D(i, i) = 2 * mode.damping * mode.omega;
      out.K(i, i) = mode.omega * mode.omega;
    }
    out.G(d, d + 1) = mode.gyroscopic;
    out.G(d + 1, d) = -mode.gyroscopic;
    // psi is beta in the x-z plane, -alpha in the y-z plane
    const double tilt = mode.gyroscopic_tilt;
    out.G(d, 3) = out.G(d + 1, 4) = -tilt;
    out.G(3, d) = out.G(4, d + 1) = tilt;
    for (std::size_t l = 0; l < mode.gyroscopic_other.size(); ++l) {
      const Index o = model.mode_dof(l);
      out.G(d, o + 1) = out.G(o, d + 1) = mode.gyroscopic_other[l];
      out.G(d + 1, o) = out.G(o + 1, d) = -mode.gyroscopic_other[l];
    }
    out.xy.push_back({static_cast<int>(d), static_cast<int>(d + 1)});
  }
}

/// Coordinates of the rotor and of mounts are relative to the base: its acceleration is theirs too.
void AddBase(const RotorModel& model, LinearRotor& out) {
  const Index d = model.base_dof();
  const BaseOnFloor& base = model.base();
  for (Index side = 0; side < 2; ++side) {
    out.M(d + side, d + side) = base.mass;
    out.D(d + side, d + side) = base.damping[static_cast<std::size_t>(side)];
    out.K(d + side, d + side) = base.stiffness[static_cast<std::size_t>(side)];
    out.M(side, d + side) = model.parameters().mass;
    for (const AuxiliaryPlane& aux : model.auxiliaries())
      if (aux.mount_dof >= 0) out.M(aux.mount_dof + side, d + side) = aux.parameters.mount_mass;
  }
}

void AddMount(const RotorModel& model, const AuxiliaryPlane& aux, LinearRotor& out) {
  const AuxiliaryParameters& p = aux.parameters;
  if (aux.race_dof >= 0) {
    out.M(aux.race_dof, aux.race_dof) = p.race_inertia;
    out.D(aux.race_dof, aux.race_dof) = p.race_drag;
  }
  if (aux.mount_dof < 0) return;
  for (Index side = 0; side < 2; ++side) {
    const Index d = aux.mount_dof + side;
    out.M(d, d) = p.mount_mass;
    out.D(d, d) = p.mount_damping;
    out.K(d, d) = p.mount_stiffness;
    if (model.base_dof() < 0) continue;
    out.D(model.base_dof() + side, d) = -p.mount_damping;  // what it pushes on the stator
    out.K(model.base_dof() + side, d) = -p.mount_stiffness;
  }
}

}  // namespace

LinearRotor Linearise(const RotorModel& model, double speed) {
  LinearRotor out;
  for (Eigen::MatrixXd* a : {&out.M, &out.G, &out.D, &out.K}) a->setZero(model.dof(), model.dof());
  const RotorParameters& p = model.parameters();
  out.M.diagonal().setOnes();
  out.M.diagonal().head<5>() << p.mass, p.mass, p.mass, p.inertia_transverse, p.inertia_transverse;
  out.G(3, 4) = p.inertia_polar;
  out.G(4, 3) = -p.inertia_polar;
  out.xy.push_back({0, 1});
  AddModes(model, out);
  for (const AuxiliaryPlane& aux : model.auxiliaries()) AddMount(model, aux, out);
  if (model.HasBase()) AddBase(model, out);
  AddTerms(model, speed, out);
  return out;
}

Eigen::MatrixXd PlaneRows(const RotorModel& model, const PlaneMap& plane) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, model.dof());
  for (std::size_t k = 0; k < static_cast<std::size_t>(plane.count); ++k) {
    rows(0, plane.dof[k]) += plane.wx[k];
    rows(1, plane.dof[k]) += plane.wy[k];
  }
  return rows;
}

Eigen::MatrixXd ForceColumns(const RotorModel& model, const PlaneMap& plane) {
  Eigen::MatrixXd columns = PlaneRows(model, plane).transpose();
  if (const int d = model.base_dof(); d >= 0)
    for (Index side = 0; side < 2; ++side) columns(d + side, side) -= 1;
  return columns;
}

}  // namespace ambrig
