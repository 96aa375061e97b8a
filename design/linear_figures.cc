#include "design/linear_figures.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {

namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr int kFrequencies = 240;
constexpr double kLowest = 0.5, kHighest = 2000;  // [Hz]

/// |S_kk| of every axis at one frequency.
Eigen::VectorXd Sensitivity(const StateSpace& P, const StateSpace& K, double hertz, double Ts) {
  const std::complex<double> z = std::polar(1.0, 2 * kPi * hertz * Ts);
  const MatrixXcd loop = MatrixXcd::Identity(P.outputs(), P.outputs()) - P.Response(z) * K.Response(z);
  return loop.inverse().diagonal().cwiseAbs();
}

/// X = A X A' + Q by doubling; A stable.
MatrixXd Covariance(MatrixXd A, MatrixXd X) {
  for (int k = 0; k < 50; ++k) {
    const MatrixXd more = A * X * A.transpose();
    X += more;
    if (!(more.norm() > 1e-14 * X.norm())) break;
    A = (A * A).eval();
  }
  return X;
}

}  // namespace

LinearFigures LinearFiguresOf(const SampledPlant& plant, const StateSpace& K, const std::vector<double>& noise, double Omega,
                              const std::vector<std::size_t>& axes) {
  LinearFigures out;
  const StateSpace P = plant.FromForce();
  const MatrixXd A = LoopMatrix(P, K);
  out.spectral_radius = SpectralRadius(A);
  out.axis_sensitivity.assign(static_cast<std::size_t>(plant.axes()), kInfinity);
  if (!out.stable()) return out;
  out.settling_time = -plant.Ts / std::log(out.spectral_radius);
  const double highest = std::min(std::max(kHighest, 3 * std::abs(Omega) / (2 * kPi)), 0.49 / plant.Ts);
  std::fill(out.axis_sensitivity.begin(), out.axis_sensitivity.end(), 0.0);
  const auto at = [&](double k) { return kLowest * std::pow(highest / kLowest, k / (kFrequencies - 1)); };
  std::vector<Eigen::VectorXd> S;
  for (int k = 0; k < kFrequencies; ++k) S.push_back(Sensitivity(P, K, at(k), plant.Ts));
  for (Eigen::Index axis = 0; axis < plant.axes(); ++axis) {
    int top = 0;
    for (int k = 1; k < kFrequencies; ++k)
      if (S[static_cast<std::size_t>(k)][axis] > S[static_cast<std::size_t>(top)][axis]) top = k;
    // Between its neighbours: a narrow peak is not missed by the grid.
    double low = std::max(top - 1, 0), high = std::min(top + 1, kFrequencies - 1), peak = S[static_cast<std::size_t>(top)][axis];
    for (int k = 0; k < 12; ++k) {
      const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
      const double sa = Sensitivity(P, K, at(a), plant.Ts)[axis], sb = Sensitivity(P, K, at(b), plant.Ts)[axis];
      peak = std::max({peak, sa, sb});
      (sa > sb ? high : low) = sa > sb ? b : a;
    }
    out.axis_sensitivity[static_cast<std::size_t>(axis)] = peak;
  }
  out.peak_sensitivity = 0;
  for (const std::size_t k : axes) out.peak_sensitivity = std::max(out.peak_sensitivity, out.axis_sensitivity[k]);
  // Noise enters beside the readings: f = K (C x + n).
  MatrixXd B(A.rows(), plant.axes()), C(plant.axes(), A.rows());
  B << P.B * K.D, K.B;
  C << K.D * P.C, K.C;
  MatrixXd n = MatrixXd::Zero(plant.axes(), plant.axes());
  for (std::size_t k = 0; k < noise.size(); ++k) n(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) = noise[k] * noise[k];
  const MatrixXd force = C * Covariance(A, B * n * B.transpose()) * C.transpose() + K.D * n * K.D.transpose();
  out.noise_force = 0;
  for (const std::size_t k : axes)
    out.noise_force = std::max(out.noise_force, std::sqrt(std::max(0.0, force(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)))));
  return out;
}

std::vector<double> SensitivityCurve(const SampledPlant& plant, const StateSpace& K, std::size_t axis, const std::vector<double>& hertz) {
  std::vector<double> out;
  for (const double f : hertz) out.push_back(Sensitivity(plant.FromForce(), K, f, plant.Ts)[static_cast<Eigen::Index>(axis)]);
  return out;
}

Eigen::MatrixXd LoadStep(const SampledPlant& plant, const StateSpace& K, std::size_t axis, std::size_t samples) {
  const Eigen::Index n = plant.A.rows();
  const MatrixXd A = LoopMatrix(plant.FromForce(), K);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.rows()), b = x;
  b.head(n) = plant.E.col(static_cast<Eigen::Index>(axis));
  MatrixXd out(plant.axes(), static_cast<Eigen::Index>(samples));
  for (Eigen::Index k = 0; k < out.cols(); ++k) {
    out.col(k) = plant.C * x.head(n);
    x = (A * x + b).eval();
  }
  return out;
}

}  // namespace ambrig
