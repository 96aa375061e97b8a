// Sampled linear systems put together: responses multiply, stand side by side, and close loops.
#include "control/linear/state_space.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

using Complex = std::complex<double>;

/// A system of two states, m inputs, p outputs with numbers that nothing cancels in.
StateSpace System(int inputs, int outputs, double seed) {
  StateSpace s;
  s.A = (Eigen::MatrixXd(2, 2) << 0.5, 0.2 * seed, -0.3, 0.7).finished();
  s.B.resize(2, inputs);
  s.C.resize(outputs, 2);
  s.D.resize(outputs, inputs);
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < inputs; ++c) s.B(r, c) = std::sin(seed + 3 * r + c);
  for (int r = 0; r < outputs; ++r) {
    for (int c = 0; c < 2; ++c) s.C(r, c) = std::cos(seed + 2 * r - c);
    for (int c = 0; c < inputs; ++c) s.D(r, c) = 0.1 * (r + 1) * seed - 0.2 * c;
  }
  return s;
}

const Complex kZ = std::polar(1.0, 0.7);

TEST(StateSpace, SeriesMultipliesResponses) {
  const StateSpace a = System(2, 3, 1), b = System(3, 1, 2);
  const Eigen::MatrixXcd both = Series(a, b).Response(kZ);
  EXPECT_LT((both - b.Response(kZ) * a.Response(kZ)).norm(), 1e-12);
  const StateSpace gain = StateSpace::Gain(Eigen::MatrixXd::Constant(1, 3, 2.0));
  EXPECT_LT((Series(a, gain).Response(kZ) - gain.Response(kZ) * a.Response(kZ)).norm(), 1e-12);
  EXPECT_EQ(gain.states(), 0);
}

TEST(StateSpace, AppendedSystemsDoNotFeelEachOther) {
  const StateSpace a = System(2, 1, 1), b = System(1, 2, 3);
  const StateSpace both = Append({a, b});
  EXPECT_EQ(both.inputs(), 3);
  EXPECT_EQ(both.outputs(), 3);
  const Eigen::MatrixXcd r = both.Response(kZ);
  EXPECT_LT((r.topLeftCorner(1, 2) - a.Response(kZ)).norm(), 1e-12);
  EXPECT_LT((r.bottomRightCorner(2, 1) - b.Response(kZ)).norm(), 1e-12);
  EXPECT_EQ(r.topRightCorner(1, 1).norm(), 0);
  EXPECT_EQ(r.bottomLeftCorner(2, 2).norm(), 0);
}

// det(z - A_loop) = det(z - A_P) det(z - A_K) det(1 - P K): the poles are where the loop gain is
// one.
TEST(StateSpace, PolesOfALoopAreWhereItsGainIsOne) {
  StateSpace P = System(1, 1, 1), K = System(1, 1, 2);
  P.D.setZero();
  const Eigen::MatrixXd A = LoopMatrix(P, K);
  ASSERT_EQ(A.rows(), 4);
  for (const Complex pole : Eigen::VectorXcd(A.eigenvalues()))
    EXPECT_LT(std::abs(1.0 - (P.Response(pole) * K.Response(pole))(0, 0)), 1e-8);
  EXPECT_NEAR(SpectralRadius(A), A.eigenvalues().cwiseAbs().maxCoeff(), 1e-12);
}

// 1/(s + a) through s = c (z - 1)/(z + 1): the response at z is that at s; prewarped at w they
// agree there with the continuous one.
TEST(StateSpace, TheBilinearMapKeepsResponses) {
  const double a = 300, Ts = 1e-3, w = 800;
  StateSpace continuous;
  continuous.A = Eigen::MatrixXd::Constant(1, 1, -a);
  continuous.B = continuous.C = Eigen::MatrixXd::Constant(1, 1, 1.0);
  continuous.D = Eigen::MatrixXd::Constant(1, 1, 0.5);
  const StateSpace plain = Bilinear(continuous, Ts), warped = Bilinear(continuous, Ts, w);
  const Complex s = 2 / Ts * (kZ - 1.0) / (kZ + 1.0);
  EXPECT_LT(std::abs(plain.Response(kZ)(0, 0) - (1.0 / (s + a) + 0.5)), 1e-12);
  const Complex exact = 1.0 / (Complex(0, w) + a) + 0.5, at = std::polar(1.0, w * Ts);
  EXPECT_LT(std::abs(warped.Response(at)(0, 0) - exact), 1e-12);
  EXPECT_GT(std::abs(plain.Response(at)(0, 0) - exact), 1e-6);
}

TEST(StateSpace, ATransferFunctionHasItsResponse) {
  const std::vector<double> n = {2, -0.3, 0.7}, d = {4, 0.5, -0.2};  // scaled on purpose
  const StateSpace s = FromTransferFunction(n, d);
  const Complex expected =
      (n[0] * kZ * kZ + n[1] * kZ + n[2]) / (d[0] * kZ * kZ + d[1] * kZ + d[2]);
  EXPECT_LT(std::abs(s.Response(kZ)(0, 0) - expected), 1e-12);
  EXPECT_EQ(s.states(), 2);
  EXPECT_LT(std::abs(FromTransferFunction({3}, {2, 1}).Response(kZ)(0, 0) - 3.0 / (2.0 * kZ + 1.0)),
            1e-12);
  EXPECT_THROW(FromTransferFunction({1, 0, 0}, {1, 0}), std::logic_error);
  EXPECT_THROW(FromTransferFunction({1}, {}), std::logic_error);
}

}  // namespace
}  // namespace ambrig
