#include "analysis/linear_plant.h"

#include <cmath>

#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Coordinates that a bearing moves, directly or through the rotor's matrices, in rising order.
std::vector<int> Moved(const LinearRotor& r, double speed) {
  const Index n = r.M.rows();
  std::vector<bool> moved(static_cast<std::size_t>(n), false);
  const auto tiny = [](double w) { return std::abs(w) < 1e-12; };
  for (const LinearPort& p : r.ports)
    for (Index d = 0; d < n; ++d)
      if (!p.B.row(d).isZero(1e-12)) moved[static_cast<std::size_t>(d)] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (Index d = 0; d < n; ++d)
      for (Index e = 0; e < n; ++e) {
        if (moved[static_cast<std::size_t>(d)] || !moved[static_cast<std::size_t>(e)] || d == e)
          continue;
        if (tiny(r.M(d, e)) && tiny(r.K(d, e)) && tiny(r.D(d, e) + speed * r.G(d, e))) continue;
        moved[static_cast<std::size_t>(d)] = grown = true;
      }
  }
  std::vector<int> kept;
  for (Index d = 0; d < n; ++d)
    if (moved[static_cast<std::size_t>(d)]) kept.push_back(static_cast<int>(d));
  return kept;
}

LinearRotor Restrict(const LinearRotor& r, const std::vector<int>& kept) {
  LinearRotor out;
  out.M = r.M(kept, kept);
  out.G = r.G(kept, kept);
  out.D = r.D(kept, kept);
  out.K = r.K(kept, kept);
  for (const auto& [x, y] : r.xy) {
    const auto at_x = std::find(kept.begin(), kept.end(), x),
               at_y = std::find(kept.begin(), kept.end(), y);
    if (at_x != kept.end() && at_y != kept.end())
      out.xy.push_back(
          {static_cast<int>(at_x - kept.begin()), static_cast<int>(at_y - kept.begin())});
  }
  for (const LinearPort& p : r.ports) {
    LinearPort port = p;
    port.B = p.B(kept, Eigen::all);
    port.C = p.C(Eigen::all, kept);
    port.gap = p.gap(Eigen::all, kept);
    out.ports.push_back(port);
  }
  return out;
}

}  // namespace

LinearPlant WithDrivenRotor(LinearPlant p) {
  const Index m = p.m();
  p.A.middleRows(m, m).setZero();
  p.pushed.setZero();
  p.pushed.middleRows(m, m).setIdentity();
  return p;
}

LinearPlant LinearisePlant(const OperatingPoint& point, double speed) {
  LinearPlant p;
  p.speed = speed;
  const LinearRotor whole = LinearRotorOf(point.plant(), speed);
  p.coordinate = Moved(whole, speed);
  p.rotor = Restrict(whole, p.coordinate);
  Index coils = 0, axes = 0;
  for (std::size_t k = 0; k < point.bearings.size(); ++k) {
    for (int lane : point.bearings[k].coils) p.coils.push_back({k, lane});
    coils += static_cast<Index>(point.bearings[k].coils.size());
    axes += p.rotor.ports[k].C.rows();
  }
  const Index m = p.rotor.M.rows(), n = 2 * m + coils;
  p.A.setZero(n, n);
  p.current.setZero(coils, n);
  for (MatrixXd* rows : {&p.reading, &p.position, &p.force}) rows->setZero(axes, n);
  MatrixXd resistance = MatrixXd::Zero(coils, coils);
  MatrixXd pull = MatrixXd::Zero(m, n);  // generalised magnetic forces
  Index c = 0, a = 0;
  for (std::size_t k = 0; k < point.bearings.size(); ++k) {
    const LinearBearing& b = point.bearings[k];
    const LinearPort& port = p.rotor.ports[k];
    const Index nc = b.I_lambda.rows(), na = port.C.rows();
    p.current.block(c, 0, nc, m) = b.I_r.leftCols(na) * port.gap;
    p.current.block(c, 2 * m + c, nc, nc) = b.I_lambda;
    resistance.diagonal().segment(c, nc) = b.resistance;
    p.reading.block(a, 0, na, m) = port.C;
    p.position.block(a, 0, na, m) = port.gap;
    p.force.block(a, 0, na, m) = b.F_r.topLeftCorner(na, na) * port.gap;
    p.force.block(a, 2 * m + c, na, nc) = b.F_lambda.topRows(na);
    pull += port.B * p.force.middleRows(a, na);
    c += nc;
    a += na;
  }
  const Eigen::PartialPivLU<MatrixXd> mass(p.rotor.M);
  p.A.block(0, m, m, m).setIdentity();
  p.A.middleRows(m, m) = mass.solve(pull);
  p.A.block(m, 0, m, m) -= mass.solve(p.rotor.K);
  p.A.block(m, m, m, m) -= mass.solve(p.rotor.D + speed * p.rotor.G);
  p.A.bottomRows(coils) = -resistance * p.current;
  p.pushed.setZero(n, m);
  p.pushed.middleRows(m, m) = mass.solve(MatrixXd::Identity(m, m));
  return p;
}

}  // namespace ambrig
