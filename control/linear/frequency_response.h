#pragma once
/// Responses of one sampled system at many frequencies: A is brought to Hessenberg form once, then
/// each response costs n² instead of n³. Source: Laub 1981, Efficient multivariable frequency
/// response computations, IEEE Trans. Automatic Control 26(2).
#include "control/linear/state_space.h"

namespace ambrig {

class FrequencyResponse {
 public:
  explicit FrequencyResponse(const StateSpace& system);
  /// C (z I - A)^-1 B + D, outputs x inputs.
  Eigen::MatrixXcd At(std::complex<double> z) const;

 private:
  using RowMajor =
      Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  RowMajor pencil_;  // -H | B, in the Hessenberg basis
  Eigen::MatrixXd C_, D_;
  Eigen::Index n_ = 0;
};

}  // namespace ambrig
