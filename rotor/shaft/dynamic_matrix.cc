#include "rotor/shaft/dynamic_matrix.h"

#include <Eigen/SparseLU>

namespace ambrig {

struct DynamicMatrix::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<std::complex<double>>> lu;
  bool analysed = false;
};

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<Complex>;

/// Three matrices with the entries of all of them, so that sums are sums of their values.
template <typename Dense>
void OnePattern(const Dense& M, const Dense& C, const Dense& K, Sparse& m, Sparse& c, Sparse& k) {
  const Eigen::Index n = M.rows();
  for (Sparse* out : {&m, &c, &k}) {
    out->resize(n, n);
    out->reserve(16 * n);
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Sparse* out : {&m, &c, &k}) out->startVec(j);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (M(i, j) == 0.0 && C(i, j) == 0.0 && K(i, j) == 0.0) continue;
      m.insertBack(i, j) = M(i, j);
      c.insertBack(i, j) = C(i, j);
      k.insertBack(i, j) = K(i, j);
    }
  }
  for (Sparse* out : {&m, &c, &k}) out->finalize();
}

}  // namespace

DynamicMatrix::DynamicMatrix(const LinearRotor& r, double speed)
    : factors_(std::make_unique<Factors>()) {
  OnePattern<Eigen::MatrixXd>(r.M, r.D + speed * r.G, r.K, M_, C_, K_);
  sum_ = K_;
}

DynamicMatrix::DynamicMatrix(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& C,
                             const Eigen::MatrixXcd& K)
    : factors_(std::make_unique<Factors>()) {
  OnePattern(M, C, K, M_, C_, K_);
  sum_ = K_;
}

DynamicMatrix::~DynamicMatrix() = default;

bool DynamicMatrix::Factorise(std::complex<double> lambda) {
  const Eigen::Index n = sum_.nonZeros();
  using Values = Eigen::Map<const Eigen::ArrayXcd>;
  Eigen::Map<Eigen::ArrayXcd>(sum_.valuePtr(), n) =
      (lambda * Values(M_.valuePtr(), n) + Values(C_.valuePtr(), n)) * lambda +
      Values(K_.valuePtr(), n);
  if (!factors_->analysed) factors_->lu.analyzePattern(sum_);
  factors_->analysed = true;
  factors_->lu.factorize(sum_);
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
