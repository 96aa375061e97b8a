#pragma once
/// Linear equations A x = b with dense matrices of free size, inverses, pseudoinverses, eigenvalues
/// of symmetric ones. Each is one call of Eigen's decomposition of that name; the templates are
/// made here once, instead of in every source that solves an equation
/// (docs/decisions/005-build-time.md). Equations of fixed size in a period of the controller
/// call Eigen themselves.
///
/// Shapes: A (n x n), b (n), B (n x m) unless a line says otherwise. A singular A is not detected:
/// the result is then not finite, or rounding errors.
#include <Eigen/Core>

namespace ambrig {

/// A⁻¹ b by L U with partial pivoting.
Eigen::VectorXd SolveLinear(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::VectorXcd SolveComplex(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);

/// A⁻¹ B, (n x m), by L U with partial pivoting.
Eigen::MatrixXd SolveLinearColumns(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::MatrixXcd SolveComplexColumns(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

/// A⁻¹ b and A⁻¹ B of a symmetric A, by L D Lᵀ; only its lower triangle is read.
Eigen::VectorXd SolveSymmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd SolveSymmetricColumns(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A = vectors diag(values) vectorsᵀ of a symmetric A, values rising; only its lower
/// triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // (n x n), orthonormal columns
};
SymmetricEigen EigenOfSymmetric(const Eigen::MatrixXd& A);

/// A⁻¹ by L U with partial pivoting.
Eigen::MatrixXd InverseOf(const Eigen::MatrixXd& A);
Eigen::MatrixXcd ComplexInverseOf(const Eigen::MatrixXcd& A);

/// The x of least length among those of least |A x - b|, A (m x n) of any rank, by complete
/// orthogonal decomposition.
Eigen::VectorXd SolveLeastNorm(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The matrix of SolveLeastNorm, (n x m) for A (m x n).
Eigen::MatrixXd PseudoinverseOf(const Eigen::MatrixXd& A);

/// The x of least |A x - b|, A (m x n), m >= n, by Q R with column pivoting.
Eigen::VectorXd SolveLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Orthonormal columns (m x n) that span those of A (m x n), m >= n, by Q R.
Eigen::MatrixXd OrthonormalColumnsOf(const Eigen::MatrixXd& A);

}  // namespace ambrig
