#include "control/position/unbalance_control.h"

#include <cmath>

#include "core/math/constants.h"

namespace ambrig {

UnbalanceControl::UnbalanceControl(std::unique_ptr<PositionController> inner, std::size_t axes,
                                   const UnbalanceControlParameters& p, double Ts)
    : inner_(std::move(inner)),
      p_(p),
      Ts_(Ts),
      gain_(std::polar(2 * p.bandwidth * Ts, p.phase_deg * kPi / 180)),
      turning_(axes),
      rest_(axes, 0.0) {}

void UnbalanceControl::Remove(const std::vector<double>& y, double Omega) {
  const bool learns = std::abs(Omega) >= p_.from_speed;
  const std::complex<double> turn = std::polar(1.0, Omega * Ts_);
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    rest_[k] = y[k] - turning_[k].real();
    if (learns)
      turning_[k] += gain_ * rest_[k];
    else
      turning_[k] *= 1 - p_.bandwidth * Ts_;
    turning_[k] *= turn;
  }
}

void UnbalanceControl::Step(const std::vector<double>& y, const std::vector<double>& r,
                            const std::vector<double>& excitation, double Omega,
                            std::vector<double>& f) {
  Remove(y, Omega);
  inner_->Step(rest_, r, excitation, Omega, f);
}

void UnbalanceControl::Hold(const std::vector<double>& force, const std::vector<double>& y,
                            const std::vector<double>& r) {
  std::fill(turning_.begin(), turning_.end(), 0.0);
  inner_->Hold(force, y, r);
}

void UnbalanceControl::Track(const std::vector<double>& y, const std::vector<double>& r,
                             double Omega, const std::vector<double>& f) {
  Remove(y, Omega);
  inner_->Track(rest_, r, Omega, f);
}

StateSpace UnbalanceControl::Linear(double Omega) const {
  const StateSpace inner = inner_->Linear(Omega);
  if (std::abs(Omega) < p_.from_speed) return inner;
  const std::complex<double> turn = std::polar(1.0, Omega * Ts_), in = turn * gain_;
  StateSpace one;
  one.A.resize(2, 2);
  one.A << turn.real() - in.real(), -turn.imag(), turn.imag() - in.imag(), turn.real();
  one.B.resize(2, 1);
  one.B << in.real(), in.imag();
  one.C.resize(1, 2);
  one.C << -1, 0;
  one.D = Eigen::MatrixXd::Constant(1, 1, 1.0);
  return Series(Append(std::vector<StateSpace>(rest_.size(), one)), inner);
}

std::unique_ptr<PositionController> UnbalanceControl::Clone() const {
  auto copy = std::make_unique<UnbalanceControl>(inner_->Clone(), rest_.size(), p_, Ts_);
  copy->turning_ = turning_;
  return copy;
}

}  // namespace ambrig
