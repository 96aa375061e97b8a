#include "rotor/shaft/dynamic_matrix.h"

#include <Eigen/SparseLU>

namespace ambrig {

struct DynamicMatrix::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<std::complex<double>>> lu;
  bool analysed = false;
};

DynamicMatrix::DynamicMatrix(const LinearRotor& r, double speed)
    : DynamicMatrix(r.M.cast<std::complex<double>>(),
                    (r.D + speed * r.G).cast<std::complex<double>>(),
                    r.K.cast<std::complex<double>>()) {}

DynamicMatrix::DynamicMatrix(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& C,
                             const Eigen::MatrixXcd& K)
    : M_(M.sparseView(1, 0)),
      C_(C.sparseView(1, 0)),
      K_(K.sparseView(1, 0)),
      factors_(std::make_unique<Factors>()) {}

DynamicMatrix::~DynamicMatrix() = default;

bool DynamicMatrix::Factorise(std::complex<double> lambda) {
  // A sum keeps the entries of all three, so that one analysis serves every lambda.
  Eigen::SparseMatrix<std::complex<double>> a = M_ * (lambda * lambda);
  a += C_ * lambda;
  a += K_;
  a.makeCompressed();
  if (!factors_->analysed) factors_->lu.analyzePattern(a);
  factors_->analysed = true;
  factors_->lu.factorize(a);
  return factors_->lu.info() == Eigen::Success;
}

Eigen::MatrixXcd DynamicMatrix::Solve(const Eigen::MatrixXcd& right) const {
  return factors_->lu.solve(right);
}

Eigen::VectorXcd DynamicMatrix::Slope(std::complex<double> lambda,
                                      const Eigen::VectorXcd& q) const {
  return M_ * (2.0 * lambda * q) + C_ * q;
}

}  // namespace ambrig
