#include "control/synthesis/lqg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/position/gain_schedule.h"
#include "control/synthesis/riccati.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Eigen::MatrixXd;

Eigen::Index N(std::size_t k) { return static_cast<Eigen::Index>(k); }

MatrixXd Mix(const MatrixXd& a, const MatrixXd& b, double w) { return (1 - w) * a + w * b; }

}  // namespace

LqgDesign DesignLqg(const SampledPlant& plant, const LqgParameters& w, const std::string& where) {
  const Eigen::Index n = plant.A.rows(), p = plant.axes();
  LqgDesign d;
  d.A = plant.A;
  d.B = plant.B;
  d.C = plant.C;
  // Forces and readings in units of their weights; the integral in units of its own.
  MatrixXd A = MatrixXd::Identity(n + p, n + p), B = MatrixXd::Zero(n + p, p),
           Q = MatrixXd::Zero(n + p, n + p);
  A.topLeftCorner(n, n) = plant.A;
  A.bottomLeftCorner(p, n) = plant.Ts / w.integral_weight * plant.C;
  B.topRows(n) = w.force_weight * plant.B;
  Q.topLeftCorner(n, n) = plant.C.transpose() * plant.C / (w.position_weight * w.position_weight);
  if (plant.V.size() > 0) Q.topLeftCorner(n, n) += plant.V.transpose() * plant.V;
  Q.bottomRightCorner(p, p).setIdentity();
  const RiccatiSolution control = SolveRiccati(A, B, Q, MatrixXd::Identity(p, p));
  const MatrixXd noise = w.force_noise * plant.E, C = plant.C / w.sensor_noise;
  MatrixXd covariance = noise * noise.transpose();
  if (plant.G.size() > 0) covariance += plant.G * plant.G.transpose();
  const RiccatiSolution filter =
      SolveRiccati(plant.A.transpose(), C.transpose(), covariance, MatrixXd::Identity(p, p));
  for (const auto& [solution, what] : {std::pair{&control, "weights"}, std::pair{&filter, "noise"}})
    if (!solution->usable())
      throw InputError(
          fmt::format("{}: no stabilising solution with these {} (residual {:.2g}, slowest pole "
                      "{:.9g}); allowed: axes that "
                      "magnets and sensors of the rig can hold",
                      where, what, solution->residual, solution->spectral_radius));
  d.Kx = w.force_weight * control.K.leftCols(n);
  d.Ki = w.force_weight / w.integral_weight * control.K.rightCols(p);
  const MatrixXd PC = filter.X * C.transpose();
  d.L = SolveSymmetricColumns(MatrixXd::Identity(p, p) + C * PC, PC.transpose()).transpose() /
        w.sensor_noise;
  MatrixXd rest = MatrixXd::Zero(n + p, n + p);
  rest.topLeftCorner(n, n) = MatrixXd::Identity(n, n) - plant.A;
  rest.topRightCorner(n, p) = -plant.B;
  rest.bottomLeftCorner(p, n) = plant.C;
  const MatrixXd target =
      rest.fullPivLu().solve(MatrixXd(MatrixXd::Identity(n + p, n + p).rightCols(p)));
  d.Nx = target.topRows(n);
  d.Nf = target.bottomRows(p);
  d.control_residual = control.residual;
  d.filter_residual = filter.residual;
  d.spectral_radius = std::max(control.spectral_radius, filter.spectral_radius);
  return d;
}

LqgController::LqgController(std::vector<double> speeds, std::vector<LqgDesign> designs,
                             std::vector<double> f_max, double Ts)
    : speeds_(std::move(speeds)),
      designs_(std::move(designs)),
      f_max_(std::move(f_max)),
      Ts_(Ts),
      now_(designs_.front()) {
  Require(speeds_.size() == designs_.size() && N(f_max_.size()) == now_.B.cols(),
          "a design per speed, a limit per axis");
  for (auto* v : {&x_, &corrected_, &work_}) v->setZero(now_.A.rows());
  for (auto* v : {&xi_, &y_, &r_, &f_}) v->setZero(now_.B.cols());
}

LqgDesign LqgController::At(double Omega) const {
  if (designs_.size() == 1) return designs_.front();
  const ScheduleSpot s = Locate(speeds_, Omega);
  const LqgDesign &a = designs_[s.low], &b = designs_[s.low + 1];
  LqgDesign d;
  d.A = Mix(a.A, b.A, s.weight);
  d.B = Mix(a.B, b.B, s.weight);
  d.C = Mix(a.C, b.C, s.weight);
  d.L = Mix(a.L, b.L, s.weight);
  d.Kx = Mix(a.Kx, b.Kx, s.weight);
  d.Ki = Mix(a.Ki, b.Ki, s.weight);
  d.Nx = Mix(a.Nx, b.Nx, s.weight);
  d.Nf = Mix(a.Nf, b.Nf, s.weight);
  return d;
}

void LqgController::Schedule(double Omega) {
  if (designs_.size() == 1 || Omega == now_speed_) return;
  now_ = At(Omega);
  now_speed_ = Omega;
}

void LqgController::Correct(const std::vector<double>& y, const std::vector<double>& r) {
  for (std::size_t k = 0; k < y.size(); ++k) {
    y_[N(k)] = y[k];
    r_[N(k)] = r[k];
  }
  f_.noalias() = y_ - now_.C * x_;
  corrected_ = x_;
  corrected_.noalias() += now_.L * f_;
}

void LqgController::Predict() {
  x_.noalias() = now_.A * corrected_;
  x_.noalias() += now_.B * f_;
}

void LqgController::Step(const std::vector<double>& y, const std::vector<double>& r,
                         const std::vector<double>& excitation, double Omega,
                         std::vector<double>& f) {
  Schedule(Omega);
  Correct(y, r);
  work_ = corrected_;
  work_.noalias() -= now_.Nx * r_;
  f_.noalias() = now_.Nf * r_;
  f_.noalias() -= now_.Kx * work_;
  f_.noalias() -= now_.Ki * xi_;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const double raw = f_[N(k)] + excitation[k], e = r[k] - y[k];
    const bool pushes_out = (raw > f_max_[k] && e > 0) || (raw < -f_max_[k] && e < 0);
    if (!pushes_out) xi_[N(k)] -= Ts_ * e;
    f[k] = std::clamp(raw, -f_max_[k], f_max_[k]);
    f_[N(k)] = f[k] - excitation[k];
  }
  Predict();
}

void LqgController::MatchIntegral() {
  xi_ = SolveLinear(now_.Ki, now_.Nf * r_ - now_.Kx * (corrected_ - now_.Nx * r_) - f_);
}

void LqgController::Hold(const std::vector<double>& force, const std::vector<double>& y,
                         const std::vector<double>& r) {
  const Eigen::Index n = now_.A.rows();
  for (std::size_t k = 0; k < force.size(); ++k) {
    y_[N(k)] = y[k];
    r_[N(k)] = r[k];
    f_[N(k)] = force[k];
  }
  // The observer's own rest under this force and these readings.
  const MatrixXd A = now_.A * (MatrixXd::Identity(n, n) - now_.L * now_.C);
  x_ = SolveLinear(MatrixXd::Identity(n, n) - A, now_.A * (now_.L * y_) + now_.B * f_);
  corrected_ = x_ + now_.L * (y_ - now_.C * x_);
  MatchIntegral();
}

void LqgController::Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
                          const std::vector<double>& f) {
  Schedule(Omega);
  Correct(y, r);
  for (std::size_t k = 0; k < f.size(); ++k) f_[N(k)] = f[k];
  MatchIntegral();
  Predict();
}

StateSpace LqgController::Linear(double Omega) const {
  const LqgDesign d = At(Omega);
  const Eigen::Index n = d.A.rows(), p = d.B.cols();
  const MatrixXd keep = MatrixXd::Identity(n, n) - d.L * d.C;
  StateSpace s;
  s.C.resize(p, n + p);
  s.C << -d.Kx * keep, -d.Ki;
  s.D = -d.Kx * d.L;
  s.A = MatrixXd::Zero(n + p, n + p);
  s.A.topLeftCorner(n, n) = d.A * keep;
  s.A.topRows(n) += d.B * s.C;
  s.A.bottomRightCorner(p, p).setIdentity();
  s.B.resize(n + p, p);
  s.B << d.A * d.L + d.B * s.D, Ts_ * MatrixXd::Identity(p, p);
  return s;
}

}  // namespace ambrig
