#include "analysis/linear/linear_bearing.h"

#include <algorithm>
#include <cmath>

#include "core/base/index.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Relaxations faster than this [rad/s] count as a damping of the flux, and all damping of a law as
// one relaxation of the second rate: 1 % of its phase at 5 kHz. Rates cost steps of the
// exponential.
constexpr double kFast = 1e6, kDampingRate = 3e6;

/// The same law with at most one fast relaxation.
LinearDrop WithoutFastRates(const LinearDrop& law) {
  LinearDrop out;
  out.slope = law.slope;
  double damping = law.damping, at_once = 0;
  for (const LinearDrop::Relaxation& r : law.relaxations) {
    if (r.rate <= kFast) {
      out.relaxations.push_back(r);
      continue;
    }
    damping += r.weight / r.rate;
    at_once -= r.weight;
  }
  if (damping > 0) {
    out.relaxations.push_back({kDampingRate, damping * kDampingRate});
    at_once += damping * kDampingRate;
  }
  for (double& slope : out.slope.v) slope += at_once;
  return out;
}

/// Small changes of all laws of a bearing together; what has no linear law is left out.
LinearDrop LinearIron(const StatorLanes& lanes) {
  LinearDrop sum;
  for (const FluxLaw* law : lanes.laws) {
    const auto own = law->LinearAt(lanes.phi);
    if (!own) continue;
    const LinearDrop one = WithoutFastRates(*own);
    for (int j = 0; j < kLanes; ++j) sum.slope[j] += one.slope[j];
    sum.relaxations.insert(sum.relaxations.end(), one.relaxations.begin(), one.relaxations.end());
  }
  return sum;
}

/// The circuit of poles with one or two windings each, differentiated where Settle has put it.
/// Columns of all its matrices: linkages of the coils that carry, r, states of the iron.
class LinearCircuit {
 public:
  LinearCircuit(const StatorLanes& lanes, const Eigen::Vector2d& r)
      : lanes_(lanes), iron_(LinearIron(lanes)), r_(r) {
    for (int j = 0; j < lanes.coils; ++j)
      if (!lanes.open[AsSize(j)] && (!lanes.unipolar || lanes.i[j] > 0)) coils_.push_back(j);
    flux_ = FluxOfColumns();
  }

  LinearBearing Derivatives() const {
    const Index n = Coils(), s = States();
    LinearBearing out;
    out.coils = coils_;
    out.current.resize(n);
    out.resistance.resize(n);
    MatrixXd I = MatrixXd::Zero(n, n + 2 + s);
    for (Index k = 0; k < n; ++k) {
      const int j = CoilAt(k);
      out.current(k) = lanes_.i[j];
      out.resistance(k) = lanes_.resistance[j];
      I(k, k) = 1;
      I.row(k) -= lanes_.n[j] * flux_.row(PoleOf(j));
      I.row(k) /= lanes_.leakage[j];
    }
    out.I_lambda = I.leftCols(n);
    out.I_r = I.middleCols(n, 2);
    out.I_z = I.rightCols(s);
    const MatrixXd F = ForceOfColumns();
    out.F_lambda = F.leftCols(n);
    out.F_r = F.middleCols(n, 2);
    out.F_z = F.rightCols(s);
    MatrixXd Z(s, n + 2 + s);
    for (Index p = 0; p < Poles(); ++p)
      for (Index k = 0; k < Relaxations(); ++k) {
        const Index z = p * Relaxations() + k;
        const double rate = iron_.relaxations[static_cast<std::size_t>(k)].rate;
        Z.row(z) = rate * flux_.row(p);
        Z(z, n + 2 + z) -= rate;
      }
    out.Z_lambda = Z.leftCols(n);
    out.Z_r = Z.middleCols(n, 2);
    out.Z_z = Z.rightCols(s);
    return out;
  }

 private:
  int PerPole() const { return lanes_.coupling == Coupling::kSides ? 2 : 1; }
  Index Poles() const { return lanes_.coils / PerPole(); }
  Index Coils() const { return static_cast<Index>(coils_.size()); }
  Index Relaxations() const { return static_cast<Index>(iron_.relaxations.size()); }
  Index States() const { return Poles() * Relaxations(); }
  Index PoleOf(int coil) const { return coil / PerPole(); }
  int CoilAt(Index k) const { return coils_[static_cast<std::size_t>(k)]; }
  int LaneOf(Index pole) const { return static_cast<int>(pole) * PerPole(); }
  Eigen::Vector2d Direction(Index pole) const {
    return {lanes_.direction_x[LaneOf(pole)], lanes_.direction_y[LaneOf(pole)]};
  }
  double Gap(Index pole) const {
    return std::max(lanes_.gap_offset[LaneOf(pole)] - Direction(pole).dot(r_),
                    kGapAtPole * lanes_.reluctance.gap0);
  }

  /// δφ_p = G_p (Σ n/L δλ + φ R'(g) d·δr + Σ w δz - U), G_p = 1/(R + slope + Σ n²/L).
  MatrixXd FluxOfColumns() const {
    const Index n = Coils();
    MatrixXd m = MatrixXd::Zero(Poles(), n + 2 + States());
    Eigen::VectorXd own(Poles());
    for (Index p = 0; p < Poles(); ++p) {
      const int lane = LaneOf(p);
      own(p) = lanes_.reluctance.Value(Gap(p)) + iron_.slope[lane];
      m.block<1, 2>(p, n) =
          lanes_.phi[lane] * lanes_.reluctance.Slope(Gap(p)) * Direction(p).transpose();
      for (Index k = 0; k < Relaxations(); ++k)
        m(p, n + 2 + p * Relaxations() + k) = iron_.relaxations[static_cast<std::size_t>(k)].weight;
    }
    for (Index k = 0; k < n; ++k) {
      const int j = CoilAt(k);
      own(PoleOf(j)) += lanes_.n[j] * lanes_.n[j] / lanes_.leakage[j];
      m(PoleOf(j), k) = lanes_.n[j] / lanes_.leakage[j];
    }
    const Eigen::VectorXd G = own.cwiseInverse();
    if (lanes_.coupling == Coupling::kFloatingRotor) {
      const Eigen::RowVectorXd potential = G.transpose() * m / G.sum();
      m.rowwise() -= potential;
    }
    return G.asDiagonal() * m;
  }

  /// f_p = d Pull(g) φ²/2, g' = -d.
  MatrixXd ForceOfColumns() const {
    MatrixXd out = MatrixXd::Zero(2, flux_.cols());
    for (Index p = 0; p < Poles(); ++p) {
      const Eigen::Vector2d d = Direction(p);
      const double phi = lanes_.phi[LaneOf(p)];
      out += d * (lanes_.reluctance.Pull(Gap(p)) * phi * flux_.row(p));
      out.middleCols(Coils(), 2) -=
          0.5 * lanes_.reluctance.PullSlope(Gap(p)) * phi * phi * d * d.transpose();
    }
    return out;
  }

  const StatorLanes& lanes_;
  LinearDrop iron_;
  Eigen::Vector2d r_;
  std::vector<int> coils_;
  MatrixXd flux_;  // (poles x columns)
};

/// No states of the iron: matrices of no columns, or rows.
void TakeStatesOut(LinearBearing& b) {
  const Index n = b.I_lambda.rows();
  b.I_z.resize(n, 0);
  b.F_z.resize(2, 0);
  b.Z_lambda.resize(0, n);
  b.Z_r.resize(0, 2);
  b.Z_z.resize(0, 0);
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
  TakeStatesOut(out);
  return out;
}

}  // namespace

LinearBearing LinearBearing::AtRest() const {
  if (states() == 0) return *this;
  // 0 = Z_λ δλ + Z_r δr + Z_z δz
  const MatrixXd z_lambda = -SolveLinearColumns(Z_z, Z_lambda), z_r = -SolveLinearColumns(Z_z, Z_r);
  LinearBearing out = *this;
  out.I_lambda += I_z * z_lambda;
  out.I_r += I_z * z_r;
  out.F_lambda += F_z * z_lambda;
  out.F_r += F_z * z_r;
  TakeStatesOut(out);
  return out;
}

Eigen::MatrixXd LinearBearing::Inductance() const { return InverseOf(AtRest().I_lambda); }

Eigen::MatrixXd LinearBearing::ForceOfCurrent() const {
  const LinearBearing rest = AtRest();
  return rest.F_lambda * InverseOf(rest.I_lambda);
}

Eigen::Matrix2d LinearBearing::NegativeStiffness() const {
  const LinearBearing rest = AtRest();
  return rest.F_r - rest.ForceOfCurrent() * rest.I_r;
}

LinearBearing LineariseBearing(const StatorLanes& lanes, const Lane& current, double x, double y) {
  if (lanes.network) return LineariseStatorNetwork(lanes, current, x, y);
  StatorLanes at = lanes;
  Lane carried{};
  for (int j = 0; j < lanes.coils; ++j)
    if (!lanes.unipolar || current[j] > 0) carried[j] = current[j];
  at.Settle(carried, x, y);
  return LinearCircuit(at, {x, y}).Derivatives();
}

Eigen::MatrixXd PatternInverse(const Eigen::MatrixXd& pattern) {
  return SolveSymmetricColumns(pattern.transpose() * pattern, pattern.transpose());
}

LinearBearing OntoPatterns(const LinearBearing& bearing, const Eigen::MatrixXd& pattern) {
  const LinearBearing b = bearing.AtRest();
  const Eigen::MatrixXd along = PatternInverse(pattern), L = b.Inductance();
  LinearBearing out;
  for (Eigen::Index k = 0; k < pattern.cols(); ++k) out.coils.push_back(static_cast<int>(k));
  out.current = along * b.current;
  out.resistance = (along * b.resistance.asDiagonal() * pattern).diagonal();
  out.I_lambda = InverseOf(along * L * pattern);
  out.I_r = out.I_lambda * along * L * b.I_r;
  out.F_lambda = b.ForceOfCurrent() * pattern * out.I_lambda;
  out.F_r = b.NegativeStiffness() + b.ForceOfCurrent() * pattern * out.I_r;
  TakeStatesOut(out);
  return out;
}

}  // namespace ambrig
