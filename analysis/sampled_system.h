#pragma once
/// Responses of a sampled linear system x_(k+1) = A x_k + B u_k, y_k = C x_k at any z,
///
///   y = C (z - A)⁻¹ B u
///
/// A is triangularised once (A = U T Uᴴ, complex Schur form), a frequency then costs O(N²).
#include <Eigen/Dense>
#include <complex>
#include <vector>

namespace ambrig {

class SampledSystem {
 public:
  SampledSystem() = default;
  SampledSystem(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C);

  /// Outputs x inputs; of these inputs only, in their order.
  Eigen::MatrixXcd At(std::complex<double> z) const;
  Eigen::MatrixXcd At(std::complex<double> z, const std::vector<Eigen::Index>& inputs) const;
  /// Outputs where x z = A x + `added`.
  Eigen::VectorXcd Under(std::complex<double> z, const Eigen::VectorXcd& added) const;
  const Eigen::VectorXcd& eigenvalues() const { return eigenvalues_; }

 private:
  /// C U (z - T)⁻¹ of right sides that stand in the triangular form.
  Eigen::MatrixXcd Outputs(std::complex<double> z, const Eigen::MatrixXcd& right) const;

  Eigen::VectorXcd eigenvalues_;
  Eigen::MatrixXcd T_, U_, B_, C_;  // B_ = Uᴴ B, C_ = C U
};

}  // namespace ambrig
