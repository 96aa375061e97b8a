#pragma once
/// P A = L U of a complex matrix whose entries lie within a band around the diagonal,
/// by Gaussian elimination with row pivoting inside the band (LAPACK's zgbtf2). Work:
/// n * below * (below + above). Source: Golub and Van Loan, Matrix Computations, 4th ed., 4.3.5.
#include <Eigen/Core>
#include <complex>
#include <vector>

namespace ambrig {

class BandedLu {
 public:
  BandedLu() = default;
  /// Entries (i, j) with -above <= i - j <= below.
  BandedLu(Eigen::Index n, Eigen::Index below, Eigen::Index above);

  /// All entries 0 again.
  void Clear();
  void Set(Eigen::Index i, Eigen::Index j, std::complex<double> value) {
    const Eigen::Index at = Place(i, j);
    re_[at] = value.real();
    im_[at] = value.imag();
  }
  /// Replaces the entries by their factors; false where a pivot is 0.
  bool Factorise();
  /// x = A^-1 x by the factors.
  void Solve(Eigen::Ref<Eigen::VectorXcd> x) const;

 private:
  Eigen::Index Place(Eigen::Index i, Eigen::Index j) const {
    return j * column_ + below_ + above_ + i - j;
  }
  Eigen::Index PivotRow(Eigen::Index j, Eigen::Index last) const;
  void SwapRows(Eigen::Index j, Eigen::Index p, Eigen::Index right);
  void Eliminate(Eigen::Index j, Eigen::Index last, Eigen::Index right);

  Eigen::Index n_ = 0, below_ = 0, above_ = 0, column_ = 0;
  std::vector<double> re_,
      im_;  // column by column; above each the `below` entries that pivoting fills
  std::vector<Eigen::Index> pivot_;
};

}  // namespace ambrig
