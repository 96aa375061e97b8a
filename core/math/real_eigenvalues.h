#pragma once
/// Eigenvalues of a real square matrix without its eigenvectors: reduction to Hessenberg form,
/// then Francis' QR iteration with double shifts on the part that has not split off yet. The
/// iteration touches that part alone, a tenth of the work of a Schur decomposition where
/// eigenvalues split off early. Sources: Francis, Computer Journal 4, 1961/62; Golub and Van Loan,
/// Matrix Computations, 4th ed., 7.5.
#include <Eigen/Core>

namespace ambrig {

/// False when an eigenvalue did not converge within 60 sweeps; `out` in no particular
/// order, conjugate pairs side by side.
bool RealEigenvalues(const Eigen::MatrixXd& a, Eigen::VectorXcd& out);

}  // namespace ambrig
