#include "design/linear_figures.h"

#include <algorithm>
#include <cmath>

#include "control/linear/frequency_response.h"
#include "core/math/constants.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr int kFrequencies = 240;
constexpr double kLowest = 0.5, kHighest = 2000;  // [Hz]

/// The loop of P and K at many frequencies.
class Loop {
 public:
  Loop(const StateSpace& P, const StateSpace& K, double Ts) : P_(P), K_(K), Ts_(Ts) {}
  /// |S_kk| of every axis, at the force command.
  Eigen::VectorXd Sensitivity(double hertz) const {
    const std::complex<double> z = std::polar(1.0, 2 * kPi * hertz * Ts_);
    const MatrixXcd G = P_.At(z);
    return ComplexInverseOf(MatrixXcd::Identity(G.cols(), G.cols()) - K_.At(z) * G)
        .diagonal()
        .cwiseAbs();
  }

 private:
  FrequencyResponse P_, K_;
  double Ts_;
};

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

/// Poles of the loop as continuous ones [1/s], oscillating with a positive frequency.
std::vector<std::complex<double>> Oscillations(const Eigen::VectorXcd& z, double Ts) {
  std::vector<std::complex<double>> out;
  for (const std::complex<double> pole : z) {
    const std::complex<double> s = std::log(pole) / Ts;
    if (s.imag() > 0 && std::isfinite(s.real())) out.push_back(s);
  }
  return out;
}

/// Frequencies for the sensitivity [Hz], ascending: logarithmic, and where the loop rings, which
/// such a grid steps over.
std::vector<double> FrequencyGrid(const std::vector<std::complex<double>>& poles, double highest) {
  std::vector<double> grid;
  for (int k = 0; k < kFrequencies; ++k)
    grid.push_back(kLowest *
                   std::pow(highest / kLowest, static_cast<double>(k) / (kFrequencies - 1)));
  for (const std::complex<double> s : poles)
    for (const double width : {-1.0, 0.0, 1.0}) {
      const double hertz = (s.imag() + width * s.real()) / (2 * kPi);
      if (hertz > kLowest && hertz < highest) grid.push_back(hertz);
    }
  std::sort(grid.begin(), grid.end());
  return grid;
}

}  // namespace

LinearFigures LinearFiguresOf(const SampledPlant& plant, const StateSpace& K,
                              const std::vector<double>& noise, double Omega,
                              const std::vector<std::size_t>& axes, double top) {
  LinearFigures out;
  const StateSpace P = plant.FromForce();
  const MatrixXd A = LoopMatrix(P, K);
  const Eigen::VectorXcd z = A.eigenvalues();
  out.spectral_radius = z.cwiseAbs().maxCoeff();
  out.axis_sensitivity.assign(static_cast<std::size_t>(plant.axes()), kInfinity);
  if (!out.stable()) return out;
  out.settling_time = -plant.Ts / std::log(out.spectral_radius);
  const auto poles = Oscillations(z, plant.Ts);
  for (const std::complex<double> s : poles)
    if (s.imag() <= top)
      out.amplification = std::max(out.amplification, std::abs(s) / (-2 * s.real()));
  const std::vector<double> grid = FrequencyGrid(
      poles, std::min(std::max(kHighest, 3 * std::abs(Omega) / (2 * kPi)), 0.49 / plant.Ts));
  std::fill(out.axis_sensitivity.begin(), out.axis_sensitivity.end(), 0.0);
  const Loop loop(P, K, plant.Ts);
  std::vector<Eigen::VectorXd> S;
  for (const double hertz : grid) S.push_back(loop.Sensitivity(hertz));
  for (Eigen::Index axis = 0; axis < plant.axes(); ++axis) {
    std::size_t most = 0;
    for (std::size_t k = 1; k < grid.size(); ++k)
      if (S[k][axis] > S[most][axis]) most = k;
    // Between its neighbours.
    double low = grid[most - (most > 0 ? 1 : 0)], high = grid[std::min(most + 1, grid.size() - 1)],
           peak = S[most][axis];
    for (int k = 0; k < 12; ++k) {
      const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
      const double sa = loop.Sensitivity(a)[axis], sb = loop.Sensitivity(b)[axis];
      peak = std::max({peak, sa, sb});
      (sa > sb ? high : low) = sa > sb ? b : a;
    }
    out.axis_sensitivity[static_cast<std::size_t>(axis)] = peak;
  }
  out.peak_sensitivity = 0;
  for (const std::size_t k : axes)
    out.peak_sensitivity = std::max(out.peak_sensitivity, out.axis_sensitivity[k]);
  // Noise enters beside the readings: f = K (C x + n).
  MatrixXd B(A.rows(), plant.axes()), C(plant.axes(), A.rows());
  B << P.B * K.D, K.B;
  C << K.D * P.C, K.C;
  MatrixXd n = MatrixXd::Zero(plant.axes(), plant.axes());
  for (std::size_t k = 0; k < noise.size(); ++k)
    n(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) = noise[k] * noise[k];
  const MatrixXd force =
      C * Covariance(A, B * n * B.transpose()) * C.transpose() + K.D * n * K.D.transpose();
  out.noise_force = 0;
  for (const std::size_t k : axes)
    out.noise_force =
        std::max(out.noise_force, std::sqrt(std::max(0.0, force(static_cast<Eigen::Index>(k),
                                                                static_cast<Eigen::Index>(k)))));
  return out;
}

std::vector<double> SensitivityCurve(const SampledPlant& plant, const StateSpace& K,
                                     std::size_t axis, const std::vector<double>& hertz) {
  std::vector<double> out;
  const Loop loop(plant.FromForce(), K, plant.Ts);
  for (const double f : hertz) out.push_back(loop.Sensitivity(f)[static_cast<Eigen::Index>(axis)]);
  return out;
}

Eigen::MatrixXd LoadStep(const SampledPlant& plant, const StateSpace& K, std::size_t axis,
                         std::size_t samples) {
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
