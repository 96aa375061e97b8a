#include "faulttolerance/redistribution/stator_distribution.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "faulttolerance/redistribution/stator_forms.h"

namespace ambrig {

namespace {

constexpr double kMet = 1e-9;       // equation error
constexpr double kMostEntry = 50;   // of an acceptable W, healthy 1
constexpr double kHeldShare = 0.6;  // of the widest disc, kept as working disc
constexpr double kDampingOfEntries = 0.05;
constexpr double kWeightOfQuadratic = 0.3;  // of what a linearised W leaves open
constexpr double kWithin = 1e-6;            // of the bounds
constexpr int kStarts = 24, kHalvings = 7;

using Solution = std::optional<Eigen::VectorXd>;

class StatorSolver {
 public:
  explicit StatorSolver(const StatorProblem& p) : p_(p), forms_(p) {
    starts_.push_back(forms_.FromMatrix(p.healthy));
    std::mt19937_64 draws(7);
    // The standard's normal distribution is not the same everywhere: a sum of uniform numbers is.
    const auto normal = [&] {
      double sum = -6;
      for (int k = 0; k < 12; ++k) sum += static_cast<double>(draws() >> 11) * 0x1p-53;
      return sum;
    };
    const bool magnets = p.network->has_magnets();
    for (int k = 1; k < kStarts; ++k) {
      Eigen::VectorXd x(forms_.size());
      for (Eigen::Index e = 0; e < x.size(); ++e) {
        const bool bias = e < forms_.live();
        x[e] = bias ? (magnets ? 0.3 * normal() : 1 + 0.7 * normal()) : 0.7 * normal();
        if (bias && p.unipolar) x[e] = std::abs(x[e]);
      }
      starts_.push_back(x);
    }
  }

  const StatorForms& forms() const { return forms_; }

  /// A solution of the first `equations` within the bounds of a disc rho, of least entries; nothing
  /// when no start ends in one.
  Solution At(int equations, double rho, bool all) const {
    const StatorBounds bounds{rho, p_.i_max / p_.c0, p_.unipolar};
    Solution best;
    double least = kInfinity;
    for (const Eigen::VectorXd& start : starts_) {
      Eigen::VectorXd x = start;
      if (SolveStatorForms(forms_, equations, kWeightOfQuadratic, bounds, kDampingOfEntries, x) >
          kMet)
        continue;
      if (bounds.Violation(forms_, x) > kWithin) continue;
      if (!all) return x;
      const double size = Cost(x);
      if (size < least) {
        least = size;
        best = x;
      }
    }
    return best;
  }

  Solution Widest(int equations, double* rho) {
    double lo = 0, hi = HealthyDisc();
    Solution at = At(equations, lo, false);
    if (!at) return {};
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = k == 0 ? hi : 0.5 * (lo + hi);
      const Solution x = At(equations, middle, false);
      if (x) {
        at = x;
        starts_.insert(starts_.begin(), *x);
        lo = middle;
        if (k == 0) break;
      } else {
        hi = middle;
      }
    }
    *rho = lo;
    return at;
  }

  bool Reachable(int equations) const {
    if (forms_.live() == 0) return false;
    const StatorBounds wide{0, kMostEntry, false};
    for (const Eigen::VectorXd& start : starts_) {
      Eigen::VectorXd x = start;
      if (SolveStatorForms(forms_, equations, 0, wide, kDampingOfEntries, x) <= kMet &&
          x.cwiseAbs().maxCoeff() <= kMostEntry)
        return true;
    }
    return false;
  }

 private:
  double Cost(const Eigen::VectorXd& x) const {
    const double open = forms_.Errors(x).squaredNorm();  // what a linearised W leaves
    const Eigen::Matrix2d K =
        DescribeStator(p_, SolvabilityClass::kNone, forms_.ToMatrix(x)).stiffness;
    const double scale = p_.k * p_.c0 * p_.c0 / p_.network->SmallestGap();
    return LargestEigenvalue(K) / scale + 0.05 * x.squaredNorm() / p_.network->coils() + 20 * open;
  }
  double HealthyDisc() const {
    StatorProblem healthy = p_;
    healthy.turns_left.setOnes();
    healthy.load.setZero();
    return DescribeStator(healthy, SolvabilityClass::kExact, p_.healthy).rho;
  }

  StatorProblem p_;
  StatorForms forms_;
  std::vector<Eigen::VectorXd> starts_;
};

}  // namespace

StatorDistribution DescribeStator(const StatorProblem& p, SolvabilityClass cls,
                                  const Eigen::MatrixXd& W) {
  StatorDistribution d;
  d.cls = cls;
  d.W = W;
  const StatorForms forms(p);
  d.residual = forms.live() > 0 ? forms.Errors(forms.FromMatrix(W)).cwiseAbs().maxCoeff() : 1;
  d.load = p.load;
  const Eigen::VectorXd carried = W.col(0) + W.rightCols(2) * (p.load / (p.k * p.c0 * p.c0));
  double rho = kInfinity;
  for (Eigen::Index j = 0; j < W.rows(); ++j) {
    const double w = W.row(j).tail(2).norm(), b = carried[j];
    if (w == 0) continue;
    rho = std::min(rho, (p.i_max / p.c0 - std::abs(b)) / w);
    if (p.unipolar) rho = std::min(rho, b / w);
  }
  d.rho = std::isfinite(rho) ? std::max(0.0, rho) : 0;
  const Eigen::VectorXd bias = p.c0 * carried.cwiseProduct(p.turns_left);
  d.stiffness = p.network->NegativeStiffness(Eigen::Vector3d::Zero(), bias).topLeftCorner<2, 2>();
  return d;
}

SolvabilityClass ClassifyStator(const StatorProblem& p) {
  const StatorSolver solver(p);
  if (solver.Reachable(solver.forms().equations())) return SolvabilityClass::kExact;
  return solver.Reachable(solver.forms().linear_equations()) ? SolvabilityClass::kLinearised
                                                             : SolvabilityClass::kNone;
}

namespace {

std::optional<StatorDistribution> Solved(const StatorProblem& p, SolvabilityClass cls) {
  StatorSolver solver(p);
  if (solver.forms().live() == 0) return {};
  const int equations = cls == SolvabilityClass::kExact ? solver.forms().equations()
                                                        : solver.forms().linear_equations();
  double rho = 0;
  const Solution widest = solver.Widest(equations, &rho);
  if (!widest || rho <= 0) return {};
  const Solution held = solver.At(equations, kHeldShare * rho, true);
  return DescribeStator(p, cls, solver.forms().ToMatrix(held ? *held : *widest));
}

}  // namespace

StatorDistribution SolveStator(const StatorProblem& p) {
  StatorProblem unloaded = p;
  unloaded.load.setZero();
  if (const auto exact = Solved(unloaded, SolvabilityClass::kExact)) return *exact;
  if (p.load.norm() > 0)
    if (const auto about_load = Solved(p, SolvabilityClass::kLinearised)) return *about_load;
  if (const auto linear = Solved(unloaded, SolvabilityClass::kLinearised)) return *linear;
  return DescribeStator(unloaded, SolvabilityClass::kNone,
                        Eigen::MatrixXd::Zero(p.network->coils(), 3));
}

}  // namespace ambrig
