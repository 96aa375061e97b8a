#include "control/linear/frequency_response.h"

namespace ambrig {

FrequencyResponse::FrequencyResponse(const StateSpace& system)
    : C_(system.C), D_(system.D), n_(system.states()) {
  if (n_ == 0) return;
  const Eigen::HessenbergDecomposition<Eigen::MatrixXd> form(system.A);
  const Eigen::MatrixXd H = form.matrixH(), Q = form.matrixQ();
  pencil_.resize(n_, n_ + system.inputs());
  pencil_.leftCols(n_) = -H.cast<std::complex<double>>();
  pencil_.rightCols(system.inputs()) = (Q.transpose() * system.B).cast<std::complex<double>>();
  C_ = system.C * Q;
}

Eigen::MatrixXcd FrequencyResponse::At(std::complex<double> z) const {
  if (n_ == 0) return D_.cast<std::complex<double>>();
  RowMajor m = pencil_;
  m.leftCols(n_).diagonal().array() += z;
  // One entry below the diagonal in each column: the larger of two rows eliminates it.
  for (Eigen::Index k = 0; k + 1 < n_; ++k) {
    const Eigen::Index rest = m.cols() - k;
    if (std::norm(m(k + 1, k)) > std::norm(m(k, k)))
      m.row(k).tail(rest).swap(m.row(k + 1).tail(rest));
    const std::complex<double> factor = m(k + 1, k) / m(k, k);
    m.row(k + 1).tail(rest) -= factor * m.row(k).tail(rest);
  }
  const Eigen::MatrixXcd x = m.leftCols(n_).triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXcd(m.rightCols(m.cols() - n_)));
  return C_ * x + D_.cast<std::complex<double>>();
}

}  // namespace ambrig
