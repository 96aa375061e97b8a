#include "analysis/linear/linear_bearing.h"

#include <cmath>

#include "actuators/magnetics/coil_network.h"
#include "core/base/index.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

/// Force of a change (dphi, dx, dy): f_p = Pull(g) φ²/2 along the pole, g' = -d.
Eigen::Vector2d ForceChange(const StatorLanes& lanes, const NetworkState& s,
                            const NetworkRates& rate, double x, double y, double dx, double dy) {
  Eigen::Vector2d out = Eigen::Vector2d::Zero();
  const int per_pole = lanes.coupling == Coupling::kSides ? 2 : 1;
  for (int j = 0; j < lanes.coils; j += per_pole) {
    const Eigen::Vector2d d(lanes.direction_x[j], lanes.direction_y[j]);
    const double g = lanes.gap_offset[j] - d.x() * x - d.y() * y, phi = s.phi[AsSize(j / per_pole)];
    const double closing = d.x() * dx + d.y() * dy;
    out += d * (lanes.reluctance.Pull(g) * phi * rate.phi[AsSize(j / per_pole)] -
                0.5 * lanes.reluctance.PullSlope(g) * closing * phi * phi);
  }
  return out;
}

/// Of any stator: with L and J = dF/di of the coils that carry, S = dF/dr at constant current and
/// dλ/dr = Jᵀ,  I_λ = L⁻¹,  I_r = -L⁻¹ Jᵀ,  F_λ = J L⁻¹,  F_r = S - J L⁻¹ Jᵀ.
LinearBearing LineariseStatorNetwork(const StatorLanes& lanes, const Lane& current, double x,
                                     double y) {
  const PoleNetwork& network = *lanes.network;
  const Eigen::Vector3d r(x, y, 0);
  LinearBearing out;
  Lane carried;
  for (int j = 0; j < lanes.coils; ++j) {
    if (lanes.open[AsSize(j)] || (lanes.unipolar && !(current[j] > 0))) continue;
    carried[j] = current[j];
    out.coils.push_back(j);
  }
  const Eigen::VectorXd counted = lanes.CountedCurrents(carried.v);
  const WindingMatrix all = network.Linkage(network.FluxAt(r).phi);
  const auto gain = network.ForceOfCurrent(r, counted);
  const auto n = static_cast<Eigen::Index>(out.coils.size());
  Eigen::MatrixXd L(n, n), J(2, n);
  out.current.resize(n);
  out.resistance.resize(n);
  const auto share = [&](int j) { return lanes.n[j] / network.TurnsOf(j); };
  for (Eigen::Index a = 0; a < n; ++a) {
    const int p = out.coils[static_cast<std::size_t>(a)];
    out.current(a) = carried[p];
    out.resistance(a) = lanes.resistance[p];
    J.col(a) = share(p) * gain.col(p).head<2>();
    for (Eigen::Index b = 0; b < n; ++b) {
      const int q = out.coils[static_cast<std::size_t>(b)];
      L(a, b) = share(p) * share(q) * all(p, q) + (a == b ? lanes.leakage[p] : 0);
    }
  }
  out.I_lambda = InverseOf(L);
  out.I_r = -out.I_lambda * J.transpose();
  out.F_lambda = J * out.I_lambda;
  out.F_r = network.NegativeStiffness(r, counted).topLeftCorner<2, 2>() + J * out.I_r;
  return out;
}

}  // namespace

Eigen::MatrixXd LinearBearing::Inductance() const { return InverseOf(I_lambda); }

Eigen::MatrixXd LinearBearing::ForceOfCurrent() const { return F_lambda * Inductance(); }

Eigen::Matrix2d LinearBearing::NegativeStiffness() const { return F_r - ForceOfCurrent() * I_r; }

LinearBearing LineariseBearing(const StatorLanes& lanes, const Lane& current, double x, double y) {
  if (lanes.network) return LineariseStatorNetwork(lanes, current, x, y);
  CoilNetwork network(lanes);
  LinearBearing out;
  double carried[kMaxWindings] = {}, lambda[kMaxWindings] = {}, slope[kMaxWindings] = {};
  for (int j = 0; j < lanes.coils; ++j) {
    network.windings[AsSize(j)].conducts = !lanes.unipolar || current[j] > 0;
    network.windings[AsSize(j)].broken = lanes.open[AsSize(j)];
    if (!network.windings[AsSize(j)].conducts || lanes.open[AsSize(j)]) continue;
    carried[j] = current[j];
    out.coils.push_back(j);
  }
  network.Linkages(carried, x, y, lambda);
  NetworkState s;
  network.Solve(lambda, x, y, s);
  const auto n = static_cast<Eigen::Index>(out.coils.size());
  out.current.resize(n);
  out.resistance.resize(n);
  out.I_lambda.resize(n, n);
  out.I_r.resize(n, 2);
  out.F_lambda.resize(2, n);
  const auto column = [&](const NetworkRates& rate, auto&& to) {
    for (Eigen::Index k = 0; k < n; ++k)
      to(k) = rate.i[AsSize(out.coils[AsSize(static_cast<int>(k))])];
  };
  NetworkRates rate;
  for (Eigen::Index k = 0; k < n; ++k) {
    const int coil = out.coils[AsSize(static_cast<int>(k))];
    out.current(k) = current[coil];
    out.resistance(k) = lanes.resistance[coil];
    slope[coil] = 1;
    network.Rates(s, slope, x, y, 0, 0, rate);
    slope[coil] = 0;
    column(rate, out.I_lambda.col(k));
    out.F_lambda.col(k) = ForceChange(lanes, s, rate, x, y, 0, 0);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double dx = axis == 0, dy = axis == 1;
    network.Rates(s, slope, x, y, dx, dy, rate);
    column(rate, out.I_r.col(axis));
    out.F_r.col(axis) = ForceChange(lanes, s, rate, x, y, dx, dy);
  }
  return out;
}

Eigen::MatrixXd PatternInverse(const Eigen::MatrixXd& pattern) {
  return SolveSymmetricColumns(pattern.transpose() * pattern, pattern.transpose());
}

LinearBearing OntoPatterns(const LinearBearing& b, const Eigen::MatrixXd& pattern) {
  const Eigen::MatrixXd along = PatternInverse(pattern), L = b.Inductance();
  LinearBearing out;
  for (Eigen::Index k = 0; k < pattern.cols(); ++k) out.coils.push_back(static_cast<int>(k));
  out.current = along * b.current;
  out.resistance = (along * b.resistance.asDiagonal() * pattern).diagonal();
  out.I_lambda = InverseOf(along * L * pattern);
  out.I_r = out.I_lambda * along * L * b.I_r;
  out.F_lambda = b.ForceOfCurrent() * pattern * out.I_lambda;
  out.F_r = b.NegativeStiffness() + b.ForceOfCurrent() * pattern * out.I_r;
  return out;
}

}  // namespace ambrig
