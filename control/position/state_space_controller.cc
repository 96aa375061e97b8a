#include "control/position/state_space_controller.h"

#include <algorithm>
#include <cmath>

#include "control/position/gain_schedule.h"
#include "core/base/errors.h"
#include "core/math/linear_equations.h"

namespace ambrig {

StateSpaceController::StateSpaceController(std::vector<double> speeds,
                                           std::vector<StateSpace> points,
                                           std::vector<double> f_max)
    : speeds_(std::move(speeds)), points_(std::move(points)), f_max_(std::move(f_max)) {
  const auto axes = static_cast<Eigen::Index>(f_max_.size());
  Require(!points_.empty() && points_.size() == speeds_.size(), "a system per speed");
  for (const StateSpace& s : points_)
    Require(s.inputs() == axes && s.outputs() == axes && s.states() == points_.front().states(),
            "systems of one size");
  now_ = points_.front();
  x_.setZero(now_.states());
  next_ = x_;
  e_.setZero(axes);
  offset_.setZero(axes);
  raw_.setZero(axes);
}

StateSpace StateSpaceController::At(double Omega) const {
  if (points_.size() == 1) return points_.front();
  const ScheduleSpot spot = Locate(speeds_, Omega);
  const StateSpace &a = points_[spot.low], &b = points_[spot.low + 1];
  const double w = spot.weight;
  return {(1 - w) * a.A + w * b.A, (1 - w) * a.B + w * b.B, (1 - w) * a.C + w * b.C,
          (1 - w) * a.D + w * b.D};
}

void StateSpaceController::Step(const std::vector<double>& y, const std::vector<double>& r,
                                const std::vector<double>& excitation, double Omega,
                                std::vector<double>& f) {
  if (points_.size() > 1 && Omega != now_speed_) {
    now_ = At(Omega);
    now_speed_ = Omega;
  }
  for (std::size_t k = 0; k < f_max_.size(); ++k) e_[static_cast<Eigen::Index>(k)] = r[k] - y[k];
  raw_.noalias() = now_.D * e_;
  raw_.noalias() += now_.C * x_;
  raw_ += offset_;
  next_.noalias() = now_.A * x_;
  next_.noalias() += now_.B * e_;
  x_.swap(next_);
  for (std::size_t k = 0; k < f_max_.size(); ++k)
    f[k] = std::clamp(raw_[static_cast<Eigen::Index>(k)] + excitation[k], -f_max_[k], f_max_[k]);
}

void StateSpaceController::Hold(const std::vector<double>& force, const std::vector<double>& y,
                                const std::vector<double>& r) {
  const Eigen::Index n = now_.states();
  Eigen::VectorXd wanted(e_.size());
  for (std::size_t k = 0; k < force.size(); ++k) {
    e_[static_cast<Eigen::Index>(k)] = r[k] - y[k];
    wanted[static_cast<Eigen::Index>(k)] = force[k];
  }
  x_.setZero(n);
  wanted -= now_.D * e_;
  if (n > 0) {
    // At rest (I - A) x = B e; what that leaves free (integrators) is chosen for the force.
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - now_.A;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rest, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double least = 1e-10 * std::max(1.0, svd.singularValues()(0));
    Eigen::Index rank = 0;
    while (rank < n && svd.singularValues()(rank) > least) ++rank;
    const Eigen::VectorXd b = svd.matrixU().leftCols(rank).transpose() * (now_.B * e_);
    x_ = svd.matrixV().leftCols(rank) * b.cwiseQuotient(svd.singularValues().head(rank));
    const Eigen::MatrixXd free = svd.matrixV().rightCols(n - rank);
    if (free.cols() > 0) x_ += free * SolveLeastNorm(now_.C * free, wanted - now_.C * x_);
  }
  offset_ = wanted - (n > 0 ? Eigen::VectorXd(now_.C * x_) : Eigen::VectorXd::Zero(wanted.size()));
}

StateSpace StateSpaceController::Linear(double Omega) const {
  StateSpace s = At(Omega);
  s.B = -s.B;
  s.D = -s.D;
  return s;
}

}  // namespace ambrig
