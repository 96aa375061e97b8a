#include "rotor/shaft/state_modes.h"

#include <algorithm>

#include "core/math/constants.h"
#include "core/math/real_eigenvalues.h"

namespace ambrig {

namespace {

using StateComplex = std::complex<double>;
constexpr StateComplex kStateI{0, 1};

/// sqrt(K_ii/M_ii) in rising order, without those that nothing holds.
std::vector<double> RatesOf(const LinearRotor& r) {
  std::vector<double> rates;
  for (Eigen::Index i = 0; i < r.K.rows(); ++i)
    if (r.K(i, i) > 0 && r.M(i, i) > 0) rates.push_back(std::sqrt(r.K(i, i) / r.M(i, i)));
  std::sort(rates.begin(), rates.end());
  return rates;
}

/// With P = shift² M + shift C + K and theta = shift/(s - shift):
///   theta² P q + theta shift (2 shift M + C) q + shift² M q = 0
StateModes SolveShifted(const LinearRotor& r, double speed, double shift) {
  const Eigen::Index n = r.M.rows();
  const Eigen::MatrixXd C = r.D + speed * r.G;
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(
      Eigen::MatrixXd(shift * shift * r.M + shift * C + r.K));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topLeftCorner(n, n) = -shift * lu.solve(Eigen::MatrixXd(2 * shift * r.M + C));
  A.topRightCorner(n, n) = -shift * shift * lu.solve(r.M);
  A.bottomLeftCorner(n, n).setIdentity();
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(A);
  Require(eigen.info() == Eigen::Success, "converged eigenvalues");
  std::vector<Eigen::Index> low;  // those far beyond are what rounding leaves of infinity
  for (Eigen::Index k = 0; k < 2 * n; ++k)
    if (std::abs(eigen.eigenvalues()(k)) > 1 / kRigidRate) low.push_back(k);
  StateModes out{Eigen::VectorXcd(low.size()), Eigen::MatrixXcd(n, low.size())};
  for (std::size_t k = 0; k < low.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    out.s(at) = shift + shift / eigen.eigenvalues()(low[k]);
    out.shape.col(at) = eigen.eigenvectors().col(low[k]).bottomRows(n);
  }
  return out;
}

Eigen::LLT<Eigen::MatrixXd> FactorOfMass(const LinearRotor& r) {
  Eigen::LLT<Eigen::MatrixXd> llt(Eigen::MatrixXd(0.5 * (r.M + r.M.transpose())));
  if (llt.info() != Eigen::Success)
    throw InputError(
        "the rotor's mass matrix is not positive definite, allowed: added masses of supports that "
        "leave every mass positive, lumped masses with rotary inertia");
  return llt;
}

/// In M^{-1/2} coordinates with velocities scaled by the highest frequency: the matrix then has the
/// size of that frequency, not of its square, and low modes keep their digits.
Eigen::MatrixXd StateMatrix(const LinearRotor& r, double speed,
                            const Eigen::LLT<Eigen::MatrixXd>& llt) {
  const Eigen::Index n = r.M.rows();
  const auto congruence = [&](const Eigen::MatrixXd& a) -> Eigen::MatrixXd {
    const Eigen::MatrixXd left = llt.matrixL().solve(a);
    return llt.matrixL().solve(left.transpose()).transpose();
  };
  Eigen::MatrixXd K = congruence(r.K), D = congruence(r.D + speed * r.G);
  if (r.M != r.M.transpose()) {  // cross-coupled added mass of a seal
    const Eigen::PartialPivLU<Eigen::MatrixXd> mass(congruence(r.M));
    K = mass.solve(Eigen::MatrixXd(K));
    D = mass.solve(Eigen::MatrixXd(D));
  }
  const double scale = std::sqrt(std::max(K.cwiseAbs().maxCoeff(), 1e-300));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.topRightCorner(n, n) *= scale;
  A.bottomLeftCorner(n, n) = -K / scale;
  A.bottomRightCorner(n, n) = -D;
  return A;
}

}  // namespace

double UsualRate(const LinearRotor& rotor) {
  const std::vector<double> rates = RatesOf(rotor);
  return rates.empty() ? 1 : rates[rates.size() / 2];
}

double StiffestRate(const LinearRotor& rotor) {
  const std::vector<double> rates = RatesOf(rotor);
  return rates.empty() ? 1 : rates.back();
}

double WhirlIndex(const std::vector<std::array<int, 2>>& xy, const Eigen::VectorXcd& q) {
  double forward = 0, backward = 0;
  for (const auto& [x, y] : xy) {
    forward += std::norm(q(x) + kStateI * q(y));
    backward += std::norm(q(x) - kStateI * q(y));
  }
  return (forward - backward) / std::max(forward + backward, 1e-300);
}

StateModes SolveState(const LinearRotor& r, double speed) {
  const Eigen::Index n = r.M.rows();
  const Eigen::LLT<Eigen::MatrixXd> llt = FactorOfMass(r);
  if (const double rate = UsualRate(r); StiffestRate(r) > kRigidRate * rate)
    return SolveShifted(r, speed, rate);
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(StateMatrix(r, speed, llt));
  Require(eigen.info() == Eigen::Success, "converged eigenvalues");
  const Eigen::MatrixXcd q = eigen.eigenvectors().topRows(n);
  const Eigen::MatrixXd real = llt.matrixU().solve(q.real()), imag = llt.matrixU().solve(q.imag());
  return {eigen.eigenvalues(), real.cast<StateComplex>() + kStateI * imag.cast<StateComplex>()};
}

bool StatePoles(const LinearRotor& r, double speed, Eigen::VectorXcd& s) {
  const Eigen::LLT<Eigen::MatrixXd> llt = FactorOfMass(r);
  if (StiffestRate(r) > kRigidRate * UsualRate(r)) return false;
  return RealEigenvalues(StateMatrix(r, speed, llt), s);
}

std::vector<double> RealPoles(const Eigen::VectorXcd& s) {
  std::vector<double> out;
  const double largest = s.cwiseAbs().maxCoeff();
  for (const StateComplex& pole : s)
    if (std::abs(pole.imag()) <= 1e-9 * largest && std::abs(pole) > 1e-7 * largest)
      out.push_back(pole.real());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<WhirlMode> OscillatoryModes(const StateModes& state, int count) {
  std::vector<WhirlMode> modes;
  // Rigid modes of a free rotor and overdamped ones have no frequency.
  const double floor = 1e-9 * state.s.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < state.s.size(); ++k)
    if (state.s(k).imag() > floor) modes.push_back(MakeWhirlMode(state.s(k), state.shape.col(k)));
  std::sort(modes.begin(), modes.end(),
            [](const auto& a, const auto& b) { return a.omega_d < b.omega_d; });
  if (static_cast<int>(modes.size()) > count) modes.resize(count);
  return modes;
}

WhirlMode MakeWhirlMode(std::complex<double> s, Eigen::VectorXcd shape) {
  WhirlMode m;
  m.s = s;
  m.omega_n = std::abs(s);
  m.omega_d = s.imag();
  m.zeta = -s.real() / m.omega_n;
  m.log_decrement = -2 * kPi * s.real() / s.imag();
  m.shape = std::move(shape);
  return m;
}

}  // namespace ambrig
