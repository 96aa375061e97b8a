#include "rotor/shaft/reduction.h"

#include <algorithm>

#include "rotor/shaft/residual_modes.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {
namespace {

/// Rigid tilt about the centre of mass in plane dofs.
Eigen::VectorXd Tilt(const BeamRotor& rotor, double z_com) {
  Eigen::VectorXd tilt(2 * rotor.z.size());
  for (std::size_t i = 0; i < rotor.z.size(); ++i) {
    tilt(2 * i) = rotor.z[i] - z_com;
    tilt(2 * i + 1) = 1;
  }
  return tilt;
}

/// Removes what rounding left of the rigid modes, exactly with respect to M.
void MakeOrthogonal(const Eigen::MatrixXd& M, const Eigen::VectorXd& rigid,
                    Eigen::MatrixXd& shape) {
  const Eigen::VectorXd weight = M * rigid;
  shape -= rigid * (weight.transpose() * shape) / weight.dot(rigid);
}

void Append(const PlaneModes& more, PlaneModes& modes) {
  PlaneModes both{Eigen::VectorXd(modes.omega.size() + more.omega.size()),
                  Eigen::MatrixXd(more.shape.rows(), modes.shape.cols() + more.shape.cols())};
  both.omega << modes.omega, more.omega;
  both.shape << modes.shape, more.shape;
  modes = std::move(both);
}

}  // namespace

ReducedRotor Reduce(const BeamRotor& rotor, int modes, const std::vector<double>& damping,
                    const std::vector<double>& stations) {
  Require(modes >= 0, "no negative mode count");
  Require(damping.size() == 1 || static_cast<int>(damping.size()) >= modes,
          "a damping ratio for every mode");
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(rotor.M.rows());
  for (Eigen::Index i = 0; i < shift.size(); i += 2) shift(i) = 1;
  // Sums of the matrices themselves: rigid part and modes then are one consistent model.
  ReducedRotor r;
  r.mass = shift.dot(rotor.M * shift);
  r.z_com = Tilt(rotor, 0).dot(rotor.M * shift) / r.mass;
  const Eigen::VectorXd tilt = Tilt(rotor, r.z_com);
  r.inertia_transverse = tilt.dot(rotor.M * tilt);
  r.inertia_polar = tilt.dot(rotor.J * tilt);
  PlaneModes free = FreeModes(rotor, modes);
  if (!stations.empty())
    Append(ResidualModes(Reduce(rotor, static_cast<int>(rotor.M.rows()), {0.0}), modes, stations),
           free);
  MakeOrthogonal(rotor.M, shift, free.shape);
  MakeOrthogonal(rotor.M, tilt, free.shape);
  for (Eigen::Index k = 0; k < free.omega.size(); ++k) {
    const double rayleigh = free.shape.col(k).dot(rotor.C * free.shape.col(k));
    r.omega.push_back(free.omega(k));
    const std::size_t own = std::min<std::size_t>(k, damping.size() - 1);
    r.zeta.push_back(damping[own] + rayleigh / (2 * free.omega(k)));
  }
  Eigen::MatrixXd basis(rotor.M.rows(), 1 + free.shape.cols());
  basis << tilt, free.shape;
  r.J = basis.transpose() * rotor.J * basis;
  r.node_z = rotor.z;
  r.elements = rotor.elements;
  r.theory = rotor.theory;
  r.shape = free.shape;
  return r;
}

ModalStation StationAt(const ReducedRotor& r, double z) {
  ModalStation station{z - r.z_com, Eigen::VectorXd::Zero(r.modes()),
                       Eigen::VectorXd::Zero(r.modes())};
  if (r.modes() == 0) return station;
  const auto above = std::upper_bound(r.node_z.begin(), r.node_z.end(), z);
  const int last = static_cast<int>(r.elements.size()) - 1;
  const int e = std::clamp(static_cast<int>(above - r.node_z.begin()) - 1, 0, last);
  const double inside = std::clamp(z - r.node_z[e], 0.0, r.elements[e].length);
  const ElementShape n = ShapeAt(r.elements[e], r.theory, inside);
  const auto dofs = r.shape.middleRows<4>(2 * e);
  station.slope = (n.psi * dofs).transpose();
  station.phi = (n.w * dofs).transpose() + (z - r.node_z[e] - inside) * station.slope;
  return station;
}

LinearRotor Linear(const ReducedRotor& r) {
  const int n = r.modes(), size = 4 + 2 * n;
  LinearRotor out;
  for (Eigen::MatrixXd* a : {&out.M, &out.G, &out.D, &out.K}) a->setZero(size, size);
  out.M.diagonal().setOnes();
  out.M.diagonal().head<4>() << r.mass, r.mass, r.inertia_transverse, r.inertia_transverse;
  const auto x = [&](int k) { return k == 0 ? 3 : 3 + k; };      // beta, eta_x
  const auto y = [&](int k) { return k == 0 ? 2 : 3 + n + k; };  // alpha (sign -), eta_y
  const auto sign = [](int k) { return k == 0 ? -1.0 : 1.0; };
  for (int k = 0; k <= n; ++k)
    for (int l = 0; l <= n; ++l) {
      out.G(x(k), y(l)) = sign(l) * r.J(k, l);
      out.G(y(k), x(l)) = -sign(k) * r.J(k, l);
    }
  out.xy.push_back({0, 1});
  for (int k = 1; k <= n; ++k) {
    for (int i : {x(k), y(k)}) {
      out.D(i, i) = 2 * r.zeta[k - 1] * r.omega[k - 1];
      out.K(i, i) = r.omega[k - 1] * r.omega[k - 1];
    }
    out.xy.push_back({x(k), y(k)});
  }
  return out;
}

Eigen::MatrixXd StationRows(const ModalStation& s) {
  const Eigen::Index n = s.phi.size();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, 4 + 2 * n);
  rows(0, 0) = rows(1, 1) = 1;
  rows(0, 3) = s.arm;
  rows(1, 2) = -s.arm;
  rows.block(0, 4, 1, n) = s.phi.transpose();
  rows.block(1, 4 + n, 1, n) = s.phi.transpose();
  return rows;
}

void AddSupport(const ReducedRotor& rotor, const SpringSupport& s, LinearRotor& linear) {
  Require(s.on_shaft() && s.on.empty() && !s.varies(), "a constant support of the shaft to ground");
  const Eigen::MatrixXd rows = StationRows(StationAt(rotor, s.z));
  Eigen::Matrix2d k, c;
  k << s.kxx, s.kxy, s.kyx, s.kyy;
  c << s.cxx, s.cxy, s.cyx, s.cyy;
  linear.K += rows.transpose() * k * rows;
  linear.D += rows.transpose() * c * rows;
}

}  // namespace ambrig
