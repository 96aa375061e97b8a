#include "rotor/shaft/dynamic_matrix.h"

#include <Eigen/SparseLU>
#include <algorithm>

#include "core/math/band_order.h"
#include "core/math/banded_lu.h"

namespace ambrig {

/// A shaft's matrix lies within 7 of its diagonal, with housings or coaxial shafts some more; what
/// is wider is left to a general sparse solver.
struct DynamicMatrix::Factors {
  explicit Factors(const Eigen::SparseMatrix<std::complex<double>>& pattern);
  bool Factorise(const Eigen::SparseMatrix<std::complex<double>>& sum);
  Eigen::MatrixXcd Solve(const Eigen::MatrixXcd& right) const;

  std::vector<int> place;  // of each unknown in the band
  bool narrow = false, analysed = false;
  BandedLu band;
  Eigen::SparseLU<Eigen::SparseMatrix<std::complex<double>>> lu;
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

constexpr int kNatural = 12, kWidest = 40;

Neighbours NeighboursOf(const Sparse& a) {
  Neighbours out(a.rows());
  for (int j = 0; j < a.outerSize(); ++j)
    for (Sparse::InnerIterator e(a, j); e; ++e)
      if (e.row() != j) {
        out[j].push_back(static_cast<int>(e.row()));
        out[e.row()].push_back(j);
      }
  for (std::vector<int>& list : out) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return out;
}

}  // namespace

DynamicMatrix::Factors::Factors(const Sparse& pattern) {
  const Neighbours neighbours = NeighboursOf(pattern);
  place = BandOrder(neighbours, kNatural);
  const int width = BandWidth(neighbours, place);
  narrow = width <= kWidest;
  if (narrow) band = BandedLu(pattern.rows(), width, width);
}

bool DynamicMatrix::Factors::Factorise(const Sparse& sum) {
  if (narrow) {
    band.Clear();
    for (int j = 0; j < sum.outerSize(); ++j)
      for (Sparse::InnerIterator e(sum, j); e; ++e) band.Set(place[e.row()], place[j], e.value());
    return band.Factorise();
  }
  if (!analysed) lu.analyzePattern(sum);
  analysed = true;
  lu.factorize(sum);
  return lu.info() == Eigen::Success;
}

Eigen::MatrixXcd DynamicMatrix::Factors::Solve(const Eigen::MatrixXcd& right) const {
  if (!narrow) return lu.solve(right);
  Eigen::MatrixXcd out(right.rows(), right.cols());
  Eigen::VectorXcd x(right.rows());
  for (Eigen::Index c = 0; c < right.cols(); ++c) {
    for (Eigen::Index i = 0; i < x.size(); ++i) x(place[i]) = right(i, c);
    band.Solve(x);
    for (Eigen::Index i = 0; i < x.size(); ++i) out(i, c) = x(place[i]);
  }
  return out;
}

DynamicMatrix::DynamicMatrix(const LinearRotor& r, double speed) {
  OnePattern<Eigen::MatrixXd>(r.M, r.D + speed * r.G, r.K, M_, C_, K_);
  sum_ = K_;
  factors_ = std::make_unique<Factors>(sum_);
}

DynamicMatrix::DynamicMatrix(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& C,
                             const Eigen::MatrixXcd& K) {
  OnePattern(M, C, K, M_, C_, K_);
  sum_ = K_;
  factors_ = std::make_unique<Factors>(sum_);
}

DynamicMatrix::~DynamicMatrix() = default;

bool DynamicMatrix::Factorise(std::complex<double> lambda) {
  const Eigen::Index n = sum_.nonZeros();
  using Values = Eigen::Map<const Eigen::ArrayXcd>;
  Eigen::Map<Eigen::ArrayXcd>(sum_.valuePtr(), n) =
      (lambda * Values(M_.valuePtr(), n) + Values(C_.valuePtr(), n)) * lambda +
      Values(K_.valuePtr(), n);
  return factors_->Factorise(sum_);
}

Eigen::MatrixXcd DynamicMatrix::Solve(const Eigen::MatrixXcd& right) const {
  return factors_->Solve(right);
}

Eigen::VectorXcd DynamicMatrix::Slope(std::complex<double> lambda,
                                      const Eigen::VectorXcd& q) const {
  return M_ * (2.0 * lambda * q) + C_ * q;
}

}  // namespace ambrig
