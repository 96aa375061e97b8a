#include "fdd/examination/shorted_coils.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math/linear_equations.h"
#include "fdd/measurement/motion_uncertainty.h"

namespace ambrig {

namespace {

using Turns = Eigen::Vector<double, kLanes>;
using Normal = Eigen::Matrix<double, kLanes, kLanes>;

constexpr double kFewestFitted = 0.02, kMostFitted = 1.05;  // shares that a fit may reach
constexpr double kLeastShort = 0.02;  // of the turns: less is no matter of several coils
// cost that leaving out a coil must add: e^-6 and its parameter
constexpr double kCertain = 16;
constexpr double kGrossOfFit = 8;   // [sd] no residual of an explanation may be larger
constexpr double kMeanSquare = 3;   // nor all together
constexpr int kSpareEquations = 6;  // more than unknowns
constexpr double kFelt = 0.3;       // [V] of a coil in another one's equation: it conducts

/// One coil's equation in one phase of one period.
struct Equation {
  int coil = 0;
  double A = 0, Ri = 0, v = 0;  // [V]
  Turns B = Turns::Zero();      // [V]
  double sd_own = 0, sd = 0;    // [V] by the current, with all turns; by everything else
  double Error(const Turns& a) const { return a[coil] * (a[coil] * A - a.dot(B) + Ri) - v; }
  double Size(const Turns& a) const { return std::hypot(a[coil] * a[coil] * sd_own, sd); }
  Turns Gradient(const Turns& a) const {
    Turns g = -a[coil] * B;
    g[coil] += 2 * a[coil] * A - a.dot(B) + Ri;
    return g;
  }
};

/// Slopes of every coil's own and mutual terms over its samples [from, from + count).
void AddSlopes(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p,
               const MovingPermeance& P, int from, int count, Equation* e) {
  const int j = e->coil;
  const double middle = from + 0.5 * (count - 1);
  double weight = 0;
  for (int k = from; k < from + count; ++k) {
    const double at = static_cast<double>(k) / s.sampling.samples, w = k - middle;
    const Lane& i = p.adc[static_cast<std::size_t>(k)];
    double total = 0;
    for (int q = 0; q < m.coils; ++q) total += P.start[q] + at * P.change[q];
    const double Pj = P.start[j] + at * P.change[j];
    for (int q = 0; q < m.coils; ++q)
      e->B[q] += w * m.n[j] * Pj * m.n[q] * (P.start[q] + at * P.change[q]) * i[q] / total;
    e->A += w * (m.n[j] * m.n[j] * Pj + m.leakage[j]) * i[j];
    weight += w * w;
  }
  e->A /= weight * s.sampling.step;
  e->B /= weight * s.sampling.step;
}

void AddEquations(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p,
                  const std::array<bool, kLanes>& judged, std::vector<Equation>* out) {
  if (!p.in.comparable) return;
  PeriodSlopes now;
  ComputePeriodSlopes(m, s.sampling, p.in, &now);
  Lane uncertainty[2];
  if (p.in.uncertainty.any()) ResidualUncertainty(m, now, p.in.uncertainty, uncertainty);
  for (int j = 0; j < m.coils; ++j) {
    if (!judged[static_cast<std::size_t>(j)] || now.largest[j] >= s.adc_limit) continue;
    for (int q = 0; q < 2; ++q) {
      const PhaseSlopes& a = now.phase[q];
      if (a.samples[j] < kFewestSamples || a.least[j] < kZeroCurrent) continue;
      const int count = static_cast<int>(a.samples[j]);
      Equation e;
      e.coil = j;
      AddSlopes(m, s, p, now.permeance, q == 0 ? 0 : static_cast<int>(now.phase[0].samples[j]),
                count, &e);
      e.Ri = m.resistance[j] * a.mean[j];
      e.v = a.voltage[j];
      const double own = m.SelfInductance(j, now.permeance.middle, now.permeance.total);
      e.sd_own =
          std::hypot(own * s.current_noise * std::sqrt(SlopeVariance(count, s.sampling.step)),
                     s.leakage_sd * a.current[j]);
      e.sd = std::hypot(s.gap_sd * e.v, s.voltage_sd, uncertainty[q][j]);
      out->push_back(e);
    }
  }
}

struct TurnsFit {
  Turns a = Turns::Ones();
  double cost = 0, worst = 0;  // sum of squares; largest residual [sd]
};

void EvaluateFit(const std::vector<Equation>& equations, TurnsFit* fit) {
  fit->cost = fit->worst = 0;
  for (const Equation& e : equations) {
    const double z = e.Error(fit->a) / e.Size(fit->a);
    fit->cost += z * z;
    fit->worst = std::max(fit->worst, std::abs(z));
  }
}

/// Levenberg-Marquardt over the turns of `coils`, from `start` there.
TurnsFit Solve(const std::vector<Equation>& equations, const std::vector<int>& coils,
               double start) {
  TurnsFit best;
  for (int j : coils) best.a[j] = start;
  EvaluateFit(equations, &best);
  double damping = 1e-3;
  for (int step = 0; step < 40 && damping < 1e6; ++step) {
    Normal H = Normal::Zero();
    Turns g = Turns::Zero();
    for (const Equation& e : equations) {
      const double size = e.Size(best.a);
      const Turns d = e.Gradient(best.a) / size;
      H += d * d.transpose();
      g += e.Error(best.a) / size * d;
    }
    const auto n = static_cast<Eigen::Index>(coils.size());
    Eigen::MatrixXd part(n, n);
    Eigen::VectorXd rhs(n);
    for (Eigen::Index r = 0; r < n; ++r) {
      const int j = coils[static_cast<std::size_t>(r)];
      rhs[r] = -g[j];
      for (Eigen::Index c = 0; c < n; ++c) part(r, c) = H(j, coils[static_cast<std::size_t>(c)]);
      part(r, r) *= 1 + damping;
      part(r, r) += 1e-9;
    }
    const Eigen::VectorXd change = SolveSymmetric(part, rhs);
    TurnsFit next = best;
    for (Eigen::Index r = 0; r < n; ++r) {
      double& a = next.a[coils[static_cast<std::size_t>(r)]];
      a = std::clamp(a + change[r], kFewestFitted, kMostFitted);
    }
    EvaluateFit(equations, &next);
    if (!(next.cost < best.cost)) {
      damping *= 10;
      continue;
    }
    const bool settled = best.cost - next.cost < 1e-3;
    best = next;
    damping = std::max(damping / 10, 1e-9);
    if (settled) break;
  }
  return best;
}

/// The best of some starts, from no turns shorted to many.
TurnsFit Solve(const std::vector<Equation>& equations, const std::vector<int>& coils) {
  TurnsFit best = Solve(equations, coils, 1);
  for (double start : {0.8, 0.6, 0.4}) {
    const TurnsFit other = Solve(equations, coils, start);
    if (other.cost < best.cost) best = other;
  }
  return best;
}

std::vector<int> Without(std::vector<int> coils, int coil) {
  coils.erase(std::remove(coils.begin(), coils.end(), coil), coils.end());
  return coils;
}

/// Whether another coil in place of one of `coils` explains as much.
bool Ambiguous(const std::vector<Equation>& equations, const std::vector<int>& coils,
               const std::vector<int>& felt, double cost) {
  for (int k : felt) {
    if (std::find(coils.begin(), coils.end(), k) != coils.end()) continue;
    for (int j : coils) {
      std::vector<int> swapped = Without(coils, j);
      swapped.push_back(k);
      if (Solve(equations, swapped).cost < cost + kCertain) return true;
    }
  }
  return false;
}

}  // namespace

ShortedCoils FindShortedCoils(const LinkageModel& m, const DetectorSettings& s,
                              const std::vector<const KeptPeriod*>& periods,
                              const std::array<bool, kLanes>& judged) {
  ShortedCoils out;
  for (double& a : out.turns_left.v) a = 1;
  std::vector<Equation> equations;
  for (const KeptPeriod* p : periods) AddEquations(m, s, *p, judged, &equations);
  // Also a coil whose own equation does not hold (its current falls to zero) is felt in the
  // others'.
  std::vector<int> felt;
  for (int j = 0; j < m.coils; ++j)
    if (judged[static_cast<std::size_t>(j)] &&
        std::any_of(equations.begin(), equations.end(),
                    [j](const Equation& e) { return e.coil == j || std::abs(e.B[j]) > kFelt; }))
      felt.push_back(j);
  if (equations.size() < felt.size() + kSpareEquations) return out;
  std::vector<int> coils = felt;
  TurnsFit fit = Solve(equations, coils);
  const auto explains = [&] {
    return fit.worst < kGrossOfFit &&
           fit.cost < kMeanSquare * static_cast<double>(equations.size());
  };
  if (!explains()) return out;
  // The fewest: healthy coils first, then whichever the residuals do not need.
  std::erase_if(coils, [&](int j) { return 1 - fit.a[j] < kLeastShort; });
  fit = Solve(equations, coils);
  double least = 1e30;
  for (bool again = true; again && coils.size() > 1;) {
    again = false;
    int spare = -1;
    least = 1e30;
    for (int j : coils) {
      const double added = Solve(equations, Without(coils, j)).cost - fit.cost;
      if (added < least) {
        least = added;
        spare = j;
      }
    }
    if (least < kCertain) {
      coils = Without(coils, spare);
      fit = Solve(equations, coils);
      again = true;
    }
  }
  if (coils.size() < 2 || !explains() || Ambiguous(equations, coils, felt, fit.cost)) return out;
  for (int j : coils) out.turns_left[j] = std::min(fit.a[j], 1.0);
  out.coils = coils;
  out.confidence = 1 / (1 + std::exp(-0.5 * least));
  return out;
}

}  // namespace ambrig
