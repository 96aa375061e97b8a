#include "effects/diffusion_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

constexpr double kFitFrom = 35, kFitTo = 3e5;      // [Hz]
constexpr double kFirstPole = 8, kLastPole = 5e5;  // [Hz]
constexpr double kTailFrequency = 1e6;             // [Hz] scale of the tail's column
constexpr int kFrequencies = 120, kColumns = kDiffusionPoles + 1;

/// min |A x - b|, x >= 0, by leaving out what comes out negative; enough for these well-spread
/// columns.
Eigen::VectorXd NonNegative(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  std::vector<int> active;
  for (int k = 0; k < A.cols(); ++k) active.push_back(k);
  while (!active.empty()) {
    const Eigen::VectorXd x = Eigen::MatrixXd(A(Eigen::all, active)).householderQr().solve(b);
    if (x.minCoeff() >= 0) {
      Eigen::VectorXd full = Eigen::VectorXd::Zero(A.cols());
      full(active) = x;
      return full;
    }
    std::vector<int> kept;
    for (std::size_t k = 0; k < active.size(); ++k)
      if (x(static_cast<Eigen::Index>(k)) > 0) kept.push_back(active[k]);
    active = kept;
  }
  return Eigen::VectorXd::Zero(A.cols());
}

}  // namespace

Complex DiffusionFit::At(Complex s) const {
  Complex sum = tail * s;
  for (int k = 0; k < kDiffusionPoles; ++k) sum += residue[k] * s / (s + pole[k]);
  return sum;
}

Complex Diffusion(Complex s, double cutoff, double rho) {
  const Complex half_order = std::sqrt(s / (2 * kPi * cutoff));
  if (rho <= 0) return half_order;
  const Complex z = half_order / rho;
  if (std::abs(z) < 1e-2) return rho * z * z * (1.0 / 3 - z * z / 45.0);  // cancellation below
  return z.real() > 300 ? half_order - rho : half_order / std::tanh(z) - rho;
}

DiffusionFit FitDiffusion(double cutoff, double rho) {
  DiffusionFit fit;
  // First pole of z coth z at z = j pi: p = pi² / τ.
  const double first = rho * rho * 2 * kPi * cutoff * kPi * kPi / (2 * kPi);  // [Hz]
  const double from = std::clamp(first, kFirstPole, 0.3 * kLastPole);
  for (int k = 0; k < kDiffusionPoles; ++k)
    fit.pole[k] = 2 * kPi * from * std::pow(kLastPole / from, k / (kDiffusionPoles - 1.0));
  Eigen::MatrixXd A(2 * kFrequencies, kColumns);
  Eigen::VectorXd b(2 * kFrequencies);
  for (int row = 0; row < kFrequencies; ++row) {
    const Complex s(0,
                    2 * kPi * kFitFrom * std::pow(kFitTo / kFitFrom, row / (kFrequencies - 1.0)));
    const Complex wanted = Diffusion(s, cutoff, rho);
    const auto set = [&](auto&& at, Complex value) {
      at(2 * row) = value.real();
      at(2 * row + 1) = value.imag();
    };
    for (int k = 0; k < kDiffusionPoles; ++k) set(A.col(k), s / (s + fit.pole[k]) / wanted);
    set(A.col(kDiffusionPoles), s / (2 * kPi * kTailFrequency) / wanted);
    set(b, 1);
  }
  const Eigen::VectorXd x = NonNegative(A, b);
  for (int k = 0; k < kDiffusionPoles; ++k) fit.residue[k] = x(k);
  fit.tail = x(kDiffusionPoles) / (2 * kPi * kTailFrequency);
  return fit;
}

}  // namespace ambrig
