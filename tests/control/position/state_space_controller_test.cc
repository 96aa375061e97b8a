/// State spaces and transfer functions as controllers: responses, sampling, holding a force.
#include "control/position/state_space_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ambrig {
namespace {

constexpr double kPeriod = 1e-4;

std::complex<double> Polynomial(const std::vector<double>& p, std::complex<double> s) {
  std::complex<double> v = 0;
  for (const double c : p) v = v * s + c;
  return v;
}

TEST(StateSpace, ResponseIsTheTransferFunction) {
  const std::vector<double> num{2, -1, 0.5}, den{4, 1, 0.25, -0.1};
  const StateSpace s = FromTransferFunction(num, den);
  for (const std::complex<double> z : {std::complex<double>(1, 0), std::polar(1.0, 0.3),
                                       std::polar(1.0, 2.5), std::complex<double>(0, 7)})
    EXPECT_LT(std::abs(s.Response(z)(0, 0) - Polynomial(num, z) / Polynomial(den, z)), 1e-12);
  const StateSpace biproper = FromTransferFunction({3, 1}, {2, 5});
  EXPECT_LT(std::abs(biproper.Response(0.7)(0, 0) - (3 * 0.7 + 1) / (2 * 0.7 + 5)), 1e-14);
  EXPECT_EQ(FromTransferFunction({6}, {3}).D(0, 0), 2);
}

// The bilinear map takes s = i w to z = exp(i W Ts) with w = 2/Ts tan(W Ts/2); prewarped, w = W at
// the chosen one.
TEST(StateSpace, BilinearMapsTheFrequencyAxis) {
  const std::vector<double> num{1, 3e3}, den{1, 400, 1e7};
  const StateSpace c = FromTransferFunction(num, den);
  for (const double W : {10.0, 3000.0, 20000.0}) {
    const double w = 2 / kPeriod * std::tan(W * kPeriod / 2);
    const std::complex<double> z = std::polar(1.0, W * kPeriod);
    const auto at = [&](double x) { return Polynomial(num, {0, x}) / Polynomial(den, {0, x}); };
    EXPECT_LT(std::abs(Bilinear(c, kPeriod).Response(z)(0, 0) - at(w)), 1e-10 * std::abs(at(w)));
    EXPECT_LT(std::abs(Bilinear(c, kPeriod, W).Response(z)(0, 0) - at(W)), 1e-10 * std::abs(at(W)));
  }
}

TEST(StateSpace, SeriesAndLoop) {
  const StateSpace a = FromTransferFunction({1, 0.5}, {1, -0.2}),
                   b = FromTransferFunction({0.3}, {1, 0.1, 0.05});
  const std::complex<double> z = std::polar(1.0, 0.9);
  EXPECT_LT(std::abs(Series(a, b).Response(z)(0, 0) - a.Response(z)(0, 0) * b.Response(z)(0, 0)),
            1e-13);
  // Poles of the loop 1 - P K = 0 with P = 1/(z - 1.2), K = -0.5: z = 0.7.
  const Eigen::MatrixXd A = LoopMatrix(FromTransferFunction({1}, {1, -1.2}),
                                       StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, -0.5)));
  EXPECT_NEAR(A(0, 0), 0.7, 1e-14);
}

// Impulse of the error: the force is D, then C A^(k-1) B: geometric for one pole.
TEST(StateSpaceController, ImpulseResponse) {
  StateSpaceController k({0}, {FromTransferFunction({10, 0}, {1, -0.9})}, {100});
  std::vector<double> f(1);
  for (int n = 0; n < 30; ++n) {
    k.Step({0}, {n == 0 ? 1.0 : 0.0}, {n == 5 ? 1.5 : 0.0}, 0, f);
    EXPECT_NEAR(f[0], 10 * std::pow(0.9, n) + (n == 5 ? 1.5 : 0), 1e-12);
  }
  k.Step({1000}, {0}, {0}, 0, f);
  EXPECT_EQ(f[0], -100);  // clamped
}

// An integrator finds its own state for a force; a controller without one gets an offset. Both keep
// it.
TEST(StateSpaceController, HoldsAForce) {
  for (const StateSpace& s :
       {FromTransferFunction({5, -4.9}, {1, -1}), FromTransferFunction({5, -2}, {1, -0.4})}) {
    StateSpaceController k({0}, {s}, {100});
    k.Hold({12}, {3e-6}, {3e-6});
    std::vector<double> f(1);
    for (int n = 0; n < 10; ++n) {
      k.Step({3e-6}, {3e-6}, {0}, 0, f);
      EXPECT_NEAR(f[0], 12, 1e-9);
    }
  }
}

TEST(StateSpaceController, InterpolatesOverTheSpeed) {
  const auto gain = [](double g) { return StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, g)); };
  StateSpaceController k({0, 100}, {gain(1), gain(3)}, {100});
  std::vector<double> f(1);
  k.Step({0}, {2}, {0}, 25, f);
  EXPECT_NEAR(f[0], 3, 1e-14);
  EXPECT_NEAR(k.Linear(-50).D(0, 0), -2, 1e-14);
}

}  // namespace
}  // namespace ambrig
