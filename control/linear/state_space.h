#pragma once
/// Sampled linear systems:  x_(k+1) = A x_k + B u_k,  y_k = C x_k + D u_k.
#include <Eigen/Dense>
#include <complex>
#include <vector>

namespace ambrig {

struct StateSpace {
  Eigen::MatrixXd A, B, C, D;  // (n x n), (n x m), (p x n), (p x m); n may be 0

  Eigen::Index states() const { return A.rows(); }
  Eigen::Index inputs() const { return D.cols(); }
  Eigen::Index outputs() const { return D.rows(); }

  static StateSpace Gain(const Eigen::MatrixXd& D);
  /// C (z I - A)^-1 B + D.
  Eigen::MatrixXcd Response(std::complex<double> z) const;
};

/// `second` after `first`.
StateSpace Series(const StateSpace& first, const StateSpace& second);
/// Side by side: own inputs, own outputs, block diagonal.
StateSpace Append(const std::vector<StateSpace>& parts);
/// Loop of plant P and controller K with positive feedback, u = K y + external: the state matrix.
Eigen::MatrixXd LoopMatrix(const StateSpace& P, const StateSpace& K);
/// Largest |eigenvalue|; below 1: stable.
double SpectralRadius(const Eigen::MatrixXd& A);

/// A continuous system sampled by the bilinear map s = c (z - 1)/(z + 1); c = 2/Ts, or w/tan(w
/// Ts/2) so that the responses at w [rad/s] are equal (prewarped; w = 0: plain).
StateSpace Bilinear(const StateSpace& continuous, double Ts, double prewarp = 0);

/// Controllable canonical form of numerator/denominator, descending powers of s or z, proper.
/// @throws std::logic_error for an improper or empty one.
StateSpace FromTransferFunction(const std::vector<double>& numerator,
                                const std::vector<double>& denominator);

}  // namespace ambrig
