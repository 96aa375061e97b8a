#include "rotor/shaft/whirl_sweep.h"

#include <algorithm>

#include "rotor/shaft/state_modes.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Adds B' (now - first) B; `now` differs in few entries.
void AddChange(const MatrixXd& now, const MatrixXd& first, const MatrixXd& B, MatrixXd& reduced) {
  for (Index j = 0; j < now.cols(); ++j)
    for (Index i = 0; i < now.rows(); ++i)
      if (const double change = now(i, j) - first(i, j); change != 0)
        reduced.noalias() += (change * B.row(i).transpose()) * B.row(j);
}

/// Poles with a frequency, the lowest first.
std::vector<std::complex<double>> OscillatoryPoles(const Eigen::VectorXcd& s) {
  std::vector<std::complex<double>> out;
  const double floor = 1e-9 * s.cwiseAbs().maxCoeff();
  for (Index k = 0; k < s.size(); ++k)
    if (s(k).imag() > floor) out.push_back(s(k));
  std::sort(out.begin(), out.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
  return out;
}

/// A shape of the reduced rotor at its pole s, by inverse iteration.
Eigen::VectorXcd ShapeAtPole(const LinearRotor& r, double speed, std::complex<double> s) {
  s *= 1 + 1e-7;  // beside the pole, where the matrix is not singular
  const Eigen::MatrixXcd C = (r.D + speed * r.G).cast<std::complex<double>>();
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(Eigen::MatrixXcd(s * s * r.M + s * C + r.K));
  Eigen::VectorXcd q = Eigen::VectorXcd::Ones(r.M.rows());
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXcd slope = 2.0 * s * (r.M * q) + C * q;
    q = lu.solve(slope).normalized();
  }
  return q;
}

}  // namespace

void WhirlSweep::Reduce() {
  if (first_.M.size() == 0) {
    first_ = rotor_;
    first_reduced_ = reduced_ = Projected(rotor_, shapes_);
    return;
  }
  reduced_ = first_reduced_;
  AddChange(rotor_.M, first_.M, shapes_, reduced_.M);
  AddChange(rotor_.G, first_.G, shapes_, reduced_.G);
  AddChange(rotor_.D, first_.D, shapes_, reduced_.D);
  AddChange(rotor_.K, first_.K, shapes_, reduced_.K);
}

bool WhirlSweep::StartFrom(const std::vector<std::complex<double>>& poles, double speed,
                           std::vector<WhirlMode>& out) const {
  std::vector<bool> used(before_.size(), false);
  for (const std::complex<double> s : poles) {
    std::size_t best = before_.size();
    double least = 0.1 * std::abs(s);
    for (std::size_t k = 0; k < before_.size(); ++k)
      if (const double away = std::abs(before_[k].s - s); !used[k] && away < least)
        least = away, best = k;
    if (best < before_.size()) {
      used[best] = true;
      out.push_back(MakeWhirlMode(s, before_[best].shape));
      continue;
    }
    out.push_back(MakeWhirlMode(s, shapes_ * ShapeAtPole(reduced_, speed, s)));
    if (IsRigidMotion(rotor_, out.back().shape)) return false;
  }
  return true;
}

bool WhirlSweep::FromNeighbour(double speed, WholeBeamModes& out) const {
  Eigen::VectorXcd s;
  if (before_.empty() || !StatePoles(reduced_, speed, s)) return false;
  std::vector<std::complex<double>> poles = OscillatoryPoles(s);
  if (static_cast<int>(poles.size()) > count_) poles.resize(count_);
  std::vector<WhirlMode> modes;
  if (!StartFrom(poles, speed, modes) || !ContinueModes(rotor_, speed, modes)) return false;
  for (std::size_t k = 0; k < poles.size(); ++k)  // else it may be the pole of another one
    if (std::abs(modes[k].s - poles[k]) > 0.02 * std::abs(poles[k])) return false;
  std::sort(modes.begin(), modes.end(),
            [](const auto& a, const auto& b) { return a.omega_d < b.omega_d; });
  out = {std::move(modes), RealPoles(s)};
  return true;
}

WholeBeamModes WhirlSweep::At(double speed) {
  AssembleInto(beam_, speed, rotor_);
  Reduce();
  WholeBeamModes out;
  if (!FromNeighbour(speed, out)) out = FindWhirlModes(rotor_, shapes_, speed, count_);
  before_ = out.oscillatory;
  return out;
}

}  // namespace ambrig
