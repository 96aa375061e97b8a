#include "faulttolerance/redistribution/stator_forms.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

constexpr double kSmoothControl = 1e-6;  // of |w|, healthy 1
constexpr double kBoundWeight = 5;
constexpr double kMargin = 1e-4;  // inside the bounds while searching
constexpr int kRounds = 60, kPolish = 12;

}  // namespace

StatorForms::StatorForms(const StatorProblem& p)
    : axes_(p.axes), coils_(p.network->coils()), magnet_(p.network->has_magnets() ? 1 / p.c0 : 0) {
  for (int j = 0; j < coils_; ++j)
    if (p.turns_left[j] > 0) live_.push_back(j);
  const PoleMatrix all = p.network->FluxAt(Eigen::Vector3d::Zero()).phi;
  Eigen::MatrixXd phi(p.network->poles(), live() + 1);
  for (int j = 0; j < live(); ++j)
    phi.col(j) = p.turns_left[live_[static_cast<std::size_t>(j)]] *
                 all.col(live_[static_cast<std::size_t>(j)]);
  phi.col(live()) = all.col(coils_);
  for (int a = 0; a < axes_; ++a) {
    Eigen::VectorXd pull(p.network->poles());
    for (int k = 0; k < p.network->poles(); ++k) {
      const NetworkPole& pole = p.network->pole(k);
      pull[k] = pole.direction[static_cast<std::size_t>(a)] / (2 * kMu0 * pole.area);
    }
    Q_[a] = phi.transpose() * pull.asDiagonal() * phi / (p.k / 2);
  }
  const auto add = [&](int from, int to) {
    for (int a = 0; a < axes_; ++a) list_.push_back({a, from, to});
  };
  add(0, 0);
  for (int c = 1; c <= axes_; ++c) add(0, c);
  for (int c = 1; c <= axes_; ++c)
    for (int d = c; d <= axes_; ++d) add(c, d);
  targets_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(list_.size()));
  for (std::size_t k = 0; k < list_.size(); ++k)
    if (list_[k].p == 0 && list_[k].q == list_[k].axis + 1)
      targets_[static_cast<Eigen::Index>(k)] = 1;
    else if (list_[k].p == 0 && list_[k].q == 0)
      targets_[static_cast<Eigen::Index>(k)] = 2 * p.load[list_[k].axis] / (p.k * p.c0 * p.c0);
  command_ = p.load / (p.k * p.c0 * p.c0);
}

Eigen::VectorXd StatorForms::Column(const Eigen::VectorXd& x, int p) const {
  Eigen::VectorXd u(live() + 1);
  u.head(live()) = x.segment(p * live(), live());
  u[live()] = p == 0 ? magnet_ : 0;
  return u;
}

Eigen::VectorXd StatorForms::Errors(const Eigen::VectorXd& x) const {
  Eigen::VectorXd e(equations());
  for (int k = 0; k < equations(); ++k) {
    const Equation& q = list_[static_cast<std::size_t>(k)];
    e[k] = Column(x, q.p).dot(Q_[q.axis] * Column(x, q.q)) - targets_[k];
  }
  return e;
}

Eigen::MatrixXd StatorForms::Jacobian(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(equations(), size());
  for (int k = 0; k < equations(); ++k) {
    const Equation& q = list_[static_cast<std::size_t>(k)];
    J.row(k).segment(q.p * live(), live()) += (Q_[q.axis] * Column(x, q.q)).head(live());
    J.row(k).segment(q.q * live(), live()) += (Q_[q.axis] * Column(x, q.p)).head(live());
  }
  return J;
}

Eigen::MatrixXd StatorForms::ToMatrix(const Eigen::VectorXd& x) const {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(coils_, 3);
  for (int j = 0; j < live(); ++j)
    for (int c = 0; c <= axes_; ++c) W(live_[static_cast<std::size_t>(j)], c) = x[c * live() + j];
  W.col(0) -= W.rightCols(2) * command_;
  return W;
}

Eigen::VectorXd StatorForms::FromMatrix(const Eigen::MatrixXd& W) const {
  Eigen::VectorXd x(size());
  for (int j = 0; j < live(); ++j)
    for (int c = 0; c <= axes_; ++c) x[c * live() + j] = W(live_[static_cast<std::size_t>(j)], c);
  for (int j = 0; j < live(); ++j)
    x[j] += W.row(live_[static_cast<std::size_t>(j)]).tail(2).dot(command_);
  return x;
}

double StatorForms::Control(const Eigen::VectorXd& x, int j, Eigen::VectorXd* slope) const {
  double square = kSmoothControl * kSmoothControl;
  for (int c = 1; c <= axes_; ++c) square += x[c * live() + j] * x[c * live() + j];
  const double size = std::sqrt(square);
  if (slope) {
    slope->setZero(this->size());
    for (int c = 1; c <= axes_; ++c) (*slope)[c * live() + j] = x[c * live() + j] / size;
  }
  return size;
}

double StatorBounds::Violation(const StatorForms& f, const Eigen::VectorXd& x) const {
  double worst = 0;
  for (int j = 0; j < f.live(); ++j) {
    const double w = rho * f.Control(x, j);
    worst = std::max(worst, std::abs(f.bias(x, j)) + w - limit);
    if (unipolar) worst = std::max(worst, w - f.bias(x, j));
  }
  return worst;
}

namespace {

/// Residuals and their Jacobian.
struct Residuals {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
};

Residuals ResidualsOf(const StatorForms& f, int equations, double others,
                      const StatorBounds& bounds, double damping, const Eigen::VectorXd& x) {
  const Eigen::Index n = f.size(), m = f.equations(), live = f.live();
  Residuals out{Eigen::VectorXd::Zero(m + 2 * live + n),
                Eigen::MatrixXd::Zero(m + 2 * live + n, n)};
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(m);
  weight.tail(m - equations).setConstant(others);
  out.r.head(m) = weight.cwiseProduct(f.Errors(x));
  out.J.topRows(m) = weight.asDiagonal() * f.Jacobian(x);
  Eigen::VectorXd slope;
  for (int j = 0; j < f.live(); ++j) {
    const double w = f.Control(x, j, &slope), b = f.bias(x, j);
    const double over = std::abs(b) + bounds.rho * w - bounds.limit + kMargin;
    const double under = bounds.rho * w - b + kMargin;
    if (over > 0) {
      out.r[m + 2 * j] = kBoundWeight * over;
      out.J.row(m + 2 * j) = kBoundWeight * bounds.rho * slope;
      out.J(m + 2 * j, j) += kBoundWeight * (b < 0 ? -1 : 1);
    }
    if (bounds.unipolar && under > 0) {
      out.r[m + 2 * j + 1] = kBoundWeight * under;
      out.J.row(m + 2 * j + 1) = kBoundWeight * bounds.rho * slope;
      out.J(m + 2 * j + 1, j) -= kBoundWeight;
    }
  }
  out.r.tail(n) = damping * x;
  out.J.bottomRows(n).diagonal().setConstant(damping);
  return out;
}

/// Steps of least norm onto the first equations.
void Polish(const StatorForms& f, int equations, Eigen::VectorXd& x) {
  for (int k = 0; k < kPolish; ++k) {
    const Eigen::VectorXd e = f.Errors(x).head(equations);
    if (e.cwiseAbs().maxCoeff() < 1e-14) return;
    x -= SolveLeastNorm(f.Jacobian(x).topRows(equations), e);
  }
}

}  // namespace

double SolveStatorForms(const StatorForms& f, int equations, double others,
                        const StatorBounds& bounds, double damping, Eigen::VectorXd& x) {
  double lambda = 1e-2;
  for (double held = damping; held > 1e-7; held *= 0.05) {
    // Towards the end nothing is weighed against the equations.
    const double open = others * held / damping;
    Residuals now = ResidualsOf(f, equations, open, bounds, held, x);
    for (int round = 0; round < kRounds; ++round) {
      Eigen::MatrixXd A = now.J.transpose() * now.J;
      A.diagonal().array() += lambda;
      const Eigen::VectorXd next = x - SolveSymmetric(A, now.J.transpose() * now.r);
      Residuals tried = ResidualsOf(f, equations, open, bounds, held, next);
      const double before = now.r.squaredNorm(), after = tried.r.squaredNorm();
      if (!(after < before)) {
        lambda = std::min(1e6, 5 * lambda);
        if (lambda >= 1e6) break;
        continue;
      }
      lambda = std::max(1e-9, 0.3 * lambda);
      x = next;
      now = std::move(tried);
      if (before - after < 1e-9 * before) break;
    }
    lambda = std::min(lambda, 1.0);
  }
  const Eigen::VectorXd searched = x;
  if (f.Errors(x).head(equations).cwiseAbs().maxCoeff() < 1e-2) Polish(f, equations, x);
  if (!x.allFinite()) x = searched;
  return f.Errors(x).head(equations).cwiseAbs().maxCoeff();
}

}  // namespace ambrig
