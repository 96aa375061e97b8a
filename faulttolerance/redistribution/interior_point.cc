#include "faulttolerance/redistribution/interior_point.h"

#include <algorithm>
#include <cmath>

namespace ambrig {
namespace {

constexpr double kToBoundary = 0.995;
constexpr double kRankThreshold = 1e-7;
constexpr int kRestorations = 4;

double LargestStep(const SmallVector& v, const SmallVector& dv) {
  double alpha = 1;
  for (int i = 0; i < v.size(); ++i)
    if (dv[i] < 0) alpha = std::min(alpha, -kToBoundary * v[i] / dv[i]);
  return alpha;
}

double Largest(const SmallVector& v) { return v.size() ? v.cwiseAbs().maxCoeff() : 0; }

/// State of the iteration and what is evaluated at it.
class InteriorPoint {
 public:
  InteriorPoint(const DistributionProgram& program, const SmallVector& x) : p_(program), x_(x) {
    s_ = p_.Bounds(x_).cwiseMax(0.05);
    z_ = (mu_ / s_.array()).matrix();
    y_ = SmallVector::Zero(p_.equations());
  }

  InteriorPointResult Run(int max_iterations, double tolerance) {
    InteriorPointResult result{};
    for (int k = 0; k < max_iterations; ++k) {
      result.iterations = k;
      Evaluate();
      if (Error(0) < tolerance) {
        result.converged = true;
        break;
      }
      while (mu_ > tolerance / 10 && Error(mu_) < 10 * mu_)
        mu_ = std::max(tolerance / 20, std::min(0.2 * mu_, std::pow(mu_, 1.5)));
      if (!Step() && !Restore()) break;
    }
    result.x = x_;
    result.objective = p_.Objective(x_);
    const SmallVector bounds = p_.Bounds(x_);
    result.infeasibility =
        std::max(Largest(p_.Equations(x_)), bounds.size() ? -bounds.minCoeff() : 0.0);
    return result;
  }

 private:
  void Evaluate() {
    g_ = p_.ObjectiveGradient(x_);
    c_ = p_.Equations(x_);
    A_ = p_.EquationJacobian(x_);
    h_ = p_.Bounds(x_);
    H_ = p_.BoundJacobian(x_);
  }

  double Error(double mu) const {
    const SmallVector dual = g_ - A_.transpose() * y_ - H_.transpose() * z_;
    const SmallVector gap = (s_.array() * z_.array() - mu).matrix();
    const double scale = 1 + (Largest(y_) + Largest(z_)) / 100;
    return std::max({Largest(dual) / scale, Largest(c_), Largest(h_ - s_), Largest(gap) / scale});
  }

  double Merit(const SmallVector& x, const SmallVector& s) const {
    return p_.Objective(x) - mu_ * s.array().log().sum() +
           nu_ * (p_.Equations(x).lpNorm<1>() + (p_.Bounds(x) - s).lpNorm<1>());
  }

  /// Newton direction dx; y_ gets the new multipliers.
  SmallVector Direction(const SmallVector& ratio, const SmallVector& slack_error) {
    const int n = p_.size();
    SmallMatrix M = p_.LagrangianHessian(x_, y_, z_) + H_.transpose() * ratio.asDiagonal() * H_;
    const SmallVector r =
        H_.transpose() * ((mu_ / s_.array()).matrix() - ratio.cwiseProduct(slack_error)) - g_;
    decomposition_.setThreshold(kRankThreshold);
    decomposition_.compute(A_.transpose());
    const int rank = static_cast<int>(decomposition_.rank());
    const SmallVector normal = Normal(c_);
    SmallMatrix Z = SmallMatrix::Zero(n, n - rank);
    Z.bottomRows(n - rank).setIdentity();
    ApplyQ(Z);
    const SmallMatrix reduced = Z.transpose() * M * Z;
    double shift = 0;
    Eigen::LLT<SmallMatrix> llt(reduced);
    while (llt.info() != Eigen::Success ||
           llt.matrixL().toDenseMatrix().diagonal().minCoeff() < 1e-6) {
      shift = shift == 0 ? std::max(1e-6, last_shift_ / 3) : shift * 4;
      if (shift > 1e12) break;
      llt.compute(reduced + shift * SmallMatrix::Identity(n - rank, n - rank));
    }
    last_shift_ = shift;
    const SmallVector dx = normal + Z * llt.solve(Z.transpose() * (r - M * normal));
    y_ = decomposition_.solve(M * dx - r);
    return dx;
  }

  /// Least-norm step that removes `error` from the linearised equations: -pinv(A) error.
  /// With A' P = Q R the step is -Q R'^-1 P' error (rank rows).
  SmallVector Normal(const SmallVector& error) const {
    const int rank = static_cast<int>(decomposition_.rank());
    const SmallVector permuted = decomposition_.colsPermutation().transpose() * error;
    SmallVector step = SmallVector::Zero(p_.size());
    const SmallMatrix R = decomposition_.matrixR().topLeftCorner(rank, rank);
    step.head(rank) = -R.triangularView<Eigen::Upper>().transpose().solve(permuted.head(rank));
    SmallMatrix column = step;
    ApplyQ(column);
    return column;
  }

  /// Product with Q by its reflections (Eigen's blocked product is slow at this size).
  void ApplyQ(SmallMatrix& columns) const {
    const SmallMatrix& qr = decomposition_.matrixQR();
    Eigen::RowVector<double, Eigen::Dynamic> workspace(columns.cols());
    for (int k = static_cast<int>(decomposition_.rank()) - 1; k >= 0; --k) {
      const int rest = p_.size() - k - 1;
      columns.bottomRows(rest + 1).applyHouseholderOnTheLeft(
          qr.col(k).tail(rest), decomposition_.hCoeffs()[k], workspace.data());
    }
  }

  bool Step() {
    const SmallVector ratio = z_.cwiseQuotient(s_), slack_error = h_ - s_;
    const SmallVector dx = Direction(ratio, slack_error);
    if (!dx.allFinite()) return false;
    const SmallVector ds = H_ * dx + slack_error;
    const SmallVector dz = (mu_ / s_.array()).matrix() - z_ - ratio.cwiseProduct(ds);
    const double wrong = c_.lpNorm<1>() + slack_error.lpNorm<1>();
    const double slope = g_.dot(dx) - mu_ * ds.cwiseQuotient(s_).sum();
    nu_ = std::max(nu_, 1.2 * std::max(Largest(y_), Largest(z_)));
    if (wrong > 1e-12) nu_ = std::max(nu_, 1.5 * slope / wrong);
    nu_ = std::min(nu_, 1e8);
    const double descent = std::min(slope - nu_ * wrong, 0.0);
    const double alpha = LineSearch(dx, ds, descent);
    if (alpha == 0) return false;
    z_ += LargestStep(z_, dz) * dz;
    for (int i = 0; i < z_.size(); ++i)
      z_[i] = std::clamp(z_[i], mu_ / (1e8 * s_[i]), 1e8 * mu_ / s_[i]);
    return true;
  }

  /// After a failed line search: back onto the equations, penalty and multipliers forgotten.
  bool Restore() {
    if (restorations_++ == kRestorations) return false;
    SolveEquations(p_, x_, 1e3, 50);
    s_ = p_.Bounds(x_).cwiseMax(std::sqrt(mu_) / 10);
    z_ = (mu_ / s_.array()).matrix();
    y_.setZero();
    nu_ = 1;
    return x_.allFinite();
  }

  bool Accept(const SmallVector& x, const SmallVector& s, double merit, double gain) {
    if ((s.array() <= 0).any() || Merit(x, s) > merit + gain + 1e-13 * std::abs(merit))
      return false;
    x_ = x;
    s_ = s;
    return true;
  }

  double LineSearch(const SmallVector& dx, const SmallVector& ds, double descent) {
    const double merit = Merit(x_, s_);
    double alpha = LargestStep(s_, ds);
    for (int trial = 0; trial < 30; ++trial, alpha /= 2) {
      const SmallVector x = x_ + alpha * dx, s = s_ + alpha * ds;
      if (Accept(x, s, merit, 1e-4 * alpha * descent)) return alpha;
      if (trial > 0) continue;
      const SmallVector corrected = x + Normal(p_.Equations(x));
      const SmallVector slack = p_.Bounds(corrected).cwiseMax((1 - kToBoundary) * s_);
      if (Accept(corrected, slack, merit, 1e-4 * alpha * descent)) return alpha;
    }
    return 0;
  }

  const DistributionProgram& p_;
  SmallVector x_, s_, y_, z_;
  SmallVector g_, c_, h_;
  SmallMatrix A_, H_;
  Eigen::ColPivHouseholderQR<SmallMatrix> decomposition_;
  double mu_ = 0.1, nu_ = 1, last_shift_ = 0;
  int restorations_ = 0;
};

}  // namespace

InteriorPointResult SolveInteriorPoint(const DistributionProgram& program, SmallVector x,
                                       int max_iterations, double tolerance) {
  return InteriorPoint(program, x).Run(max_iterations, tolerance);
}

double SolveEquations(const DistributionProgram& program, SmallVector& x, double limit,
                      int max_iterations) {
  double damping = 1e-2;
  SmallVector c = program.Equations(x);
  for (int k = 0; k < max_iterations && Largest(c) > 1e-15; ++k) {
    const SmallMatrix A = program.EquationJacobian(x);
    SmallMatrix N = A * A.transpose();
    N.diagonal().array() += damping * c.norm();  // goes to zero with the error: fast at the end
    const SmallVector trial = x - A.transpose() * N.ldlt().solve(c);
    const SmallVector error = program.Equations(trial);
    if (error.norm() < c.norm()) {
      x = trial;
      c = error;
      damping = std::max(damping / 3, 1e-12);
    } else {
      damping *= 4;
      if (damping * c.norm() > 1e12) break;
    }
    if (Largest(x.head(3 * program.live_count())) > limit) return Largest(c) + 1;
  }
  return Largest(c);
}

}  // namespace ambrig
