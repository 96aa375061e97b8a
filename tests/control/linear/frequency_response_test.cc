/// The quick response against the plain one.
#include "control/linear/frequency_response.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ambrig {
namespace {

TEST(FrequencyResponse, IsTheSystemsResponse) {
  std::srand(5);
  for (const int n : {0, 1, 2, 9, 40}) {
    StateSpace s;
    s.A = 0.2 * Eigen::MatrixXd::Random(n, n);
    s.B = Eigen::MatrixXd::Random(n, 3);
    s.C = Eigen::MatrixXd::Random(2, n);
    s.D = Eigen::MatrixXd::Random(2, 3);
    if (n > 2) s.A.row(1).setZero();  // a pole at 0
    const FrequencyResponse quick(s);
    for (const double turn : {0.0, 1e-3, 0.4, 1.0}) {
      const std::complex<double> z = std::polar(1.0, std::numbers::pi * turn);
      const Eigen::MatrixXcd plain = s.Response(z);
      EXPECT_LT((quick.At(z) - plain).norm(), 1e-11 * plain.norm()) << n << ' ' << turn;
    }
  }
}

// Block diagonal systems have zeros below the diagonal.
TEST(FrequencyResponse, OfSystemsSideBySide) {
  const StateSpace one = FromTransferFunction({1, 0.2}, {1, -0.5, 0.3}),
                   two = Append({one, one, one});
  const std::complex<double> z = std::polar(1.0, 0.7);
  EXPECT_LT((FrequencyResponse(two).At(z) - two.Response(z)).norm(), 1e-13);
}

}  // namespace
}  // namespace ambrig
