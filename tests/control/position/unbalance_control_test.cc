/// The synchronous notch: what turns with the shaft leaves the controller's view, at the rate
/// promised; the rest stays.
#include "control/position/unbalance_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/position/state_space_controller.h"

namespace ambrig {
namespace {

constexpr double kUnbalanceTs = 80e-6;

UnbalanceControl MakeUnbalance(double phase = 0) {
  auto inner = std::make_unique<StateSpaceController>(
      std::vector<double>{0},
      std::vector<StateSpace>{StateSpace::Gain(Eigen::MatrixXd::Constant(1, 1, 1.0))},
      std::vector<double>{1e9});
  return UnbalanceControl(std::move(inner), 1, {200, 20, phase}, kUnbalanceTs);
}

double AmplitudeOf(UnbalanceControl& k, double Omega, double w, double from, double seconds) {
  std::vector<double> f(1);
  double c = 0, s = 0;
  long n = 0;
  for (long i = 0; static_cast<double>(i) * kUnbalanceTs < from + seconds; ++i) {
    const double t = static_cast<double>(i) * kUnbalanceTs;
    k.Step({std::cos(w * t + 0.4)}, {0}, {0}, Omega, f);
    if (t < from) continue;
    c += f[0] * std::cos(w * t);
    s += f[0] * std::sin(w * t);
    ++n;
  }
  return 2 * std::hypot(c, s) / static_cast<double>(n);
}

// Open loop (S = 1): the synchronous part decays as exp(-b t).
TEST(UnbalanceControl, RemovesWhatTurnsWithTheShaft) {
  const double Omega = 2 * std::acos(-1.0) * 100;
  UnbalanceControl early = MakeUnbalance();
  EXPECT_NEAR(AmplitudeOf(early, Omega, Omega, 0.1, 0.01), std::exp(-20 * 0.105), 0.03);
  UnbalanceControl late = MakeUnbalance();
  EXPECT_LT(AmplitudeOf(late, Omega, Omega, 1.0, 0.1), 1e-4);
}

// Other frequencies pass; below its speed it does nothing.
TEST(UnbalanceControl, LeavesTheRest) {
  const double Omega = 2 * std::acos(-1.0) * 100;
  UnbalanceControl other = MakeUnbalance();
  EXPECT_NEAR(AmplitudeOf(other, Omega, 3 * Omega, 1.0, 0.1), 1, 0.03);
  UnbalanceControl slow = MakeUnbalance();
  EXPECT_NEAR(AmplitudeOf(slow, 150, 150, 1.0, 2 * std::acos(-1.0) / 150 * 4), 1, 1e-3);
}

TEST(UnbalanceControl, LinearModelIsTheNotch) {
  const double Omega = 700;
  UnbalanceControl k = MakeUnbalance(30);
  const StateSpace s = k.Linear(Omega);
  EXPECT_LT(std::abs(s.Response(std::polar(1.0, Omega * kUnbalanceTs))(0, 0)), 1e-9);
  EXPECT_NEAR(std::abs(s.Response(std::polar(1.0, 5 * Omega * kUnbalanceTs))(0, 0)), 1, 0.02);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(s.states());
  std::vector<double> f(1);
  for (int n = 0; n < 300; ++n) {
    const double y = std::sin(0.07 * n) + 0.1 * n;
    k.Step({y}, {0}, {0}, Omega, f);
    EXPECT_NEAR(f[0], (s.C * x)(0) + s.D(0, 0) * y, 1e-9) << n;
    x = (s.A * x + s.B * y).eval();
  }
}

}  // namespace
}  // namespace ambrig
