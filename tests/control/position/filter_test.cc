/// Filters behind a PID against the closed forms of their continuous originals.
#include "control/position/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "control/position/filtered_pid.h"

namespace ambrig {
namespace {

constexpr double kFilterTs = 80e-6;
constexpr PidParameters kGains = {4e5, 900, 6e6, 1.5e-4, 60};

std::complex<double> ResponseAt(const Biquad& q, double hertz) {
  return q.Linear().Response(std::polar(1.0, 2 * std::numbers::pi * hertz * kFilterTs))(0, 0);
}

FilterParameters Notch(double frequency, double width, double depth) {
  FilterParameters p;
  p.frequency = frequency;
  p.width = width;
  p.depth = depth;
  return p;
}

// Prewarped: the depth at the centre is the continuous filter's, whatever the sampling; gain 1 at
// rest.
TEST(Filter, NotchDepthAtItsFrequency) {
  for (const double f : {100.0, 1200.0, 5000.0})
    for (const double depth : {0.0, 0.05, 0.5}) {
      const Biquad q = SampleFilter(Notch(f, 0.2 * f, depth), kFilterTs);
      EXPECT_NEAR(std::abs(ResponseAt(q, f)), depth, 1e-12) << f;
      EXPECT_NEAR(std::abs(ResponseAt(q, 0)), 1, 1e-12);
      // Far below the sampling rate the edges of the width are at -3 dB of a full notch.
      if (depth == 0 && f < 200) {
        EXPECT_NEAR(std::abs(ResponseAt(q, f * (std::sqrt(1.01) + 0.1))), std::sqrt(0.5), 2e-3);
      }
    }
}

// Phase at the centre of a lead is asin((p - z)/(p + z)), gain sqrt(p/z).
TEST(Filter, LeadAtItsCentre) {
  FilterParameters p;
  p.kind = FilterKind::kLeadLag;
  p.zero = 400;
  p.pole = 3000;
  const auto g = ResponseAt(SampleFilter(p, kFilterTs), std::sqrt(p.zero * p.pole));
  EXPECT_NEAR(std::arg(g), std::asin((p.pole - p.zero) / (p.pole + p.zero)), 1e-12);
  EXPECT_NEAR(std::abs(g), std::sqrt(p.pole / p.zero), 1e-12);
  std::swap(p.zero, p.pole);
  EXPECT_NEAR(std::arg(ResponseAt(SampleFilter(p, kFilterTs), std::sqrt(p.zero * p.pole))),
              -std::asin(2600.0 / 3400.0), 1e-12);
}

// At its corner a second order low-pass has gain 1/(2 zeta) and a quarter turn.
TEST(Filter, LowPassAtItsCorner) {
  FilterParameters p;
  p.kind = FilterKind::kLowPass;
  p.frequency = 2000;
  p.damping = 0.4;
  const auto g = ResponseAt(SampleFilter(p, kFilterTs), 2000);
  EXPECT_NEAR(std::abs(g), 1.25, 1e-12);
  EXPECT_NEAR(std::arg(g), -std::numbers::pi / 2, 1e-12);
}

// The recursion is its state space.
TEST(Filter, StepsAreTheStateSpace) {
  Biquad q = SampleFilter(Notch(900, 300, 0.1), kFilterTs);
  const StateSpace s = q.Linear();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  for (int k = 0; k < 50; ++k) {
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, std::sin(0.3 * k * k));
    EXPECT_NEAR(q.Step(u[0]), (s.C * x + s.D * u)(0), 1e-12);
    x = (s.A * x + s.B * u).eval();
  }
  q.Hold(7);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(q.Step(7), 7, 1e-12);
}

TEST(FilteredPid, WithoutFiltersIsThePid) {
  DecentralisedPid plain({kGains}, kFilterTs);
  FilteredPid filtered({{PidSchedule{{0}, {kGains}}, {}}}, kFilterTs);
  std::vector<double> a(1), b(1);
  for (int k = 0; k < 200; ++k) {
    const std::vector<double> y{3e-5 * std::sin(0.1 * k) + 1e-4 * (k > 100)}, r{1e-6 * k},
        e{k == 50 ? 70.0 : 0.0};
    plain.Step(y, r, e, 0, a);
    filtered.Step(y, r, e, 0, b);
    EXPECT_EQ(a[0], b[0]) << k;
  }
}

TEST(FilteredPid, LinearIsTheResponseToSmallSignals) {
  FilteredPid pid({{PidSchedule{{0}, {kGains}},
                    {SampleFilter(Notch(900, 300, 0.1), kFilterTs),
                     SampleFilter(Notch(2000, 500, 0), kFilterTs)}}},
                  kFilterTs);
  const StateSpace s = pid.Linear(0);
  pid.Hold({0}, {0}, {0});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(s.states());
  std::vector<double> f(1);
  for (int k = 0; k < 300; ++k) {
    const double y = 1e-6 * std::sin(0.05 * k + 1e-3 * k * k);
    pid.Step({y}, {0}, {0}, 0, f);
    EXPECT_NEAR(f[0], (s.C * x)(0) + s.D(0, 0) * y, 1e-10) << k;
    x = (s.A * x + s.B * y).eval();
  }
}

// Gains half way between two speeds; outside the ends hold; backwards is as forwards.
TEST(FilteredPid, GainsFollowTheSpeed) {
  PidParameters fast = kGains;
  fast.kp = 2e5;
  fast.ki = 0;
  const PidSchedule s{{100, 300}, {kGains, fast}};
  EXPECT_EQ(s.At(0).kp, 4e5);
  EXPECT_NEAR(s.At(200).kp, 3e5, 1e-6);
  EXPECT_NEAR(s.At(-200).ki, 3e6, 1e-6);
  EXPECT_EQ(s.At(1000).kp, 2e5);
  FilteredPid pid({{s, {}}}, kFilterTs);
  pid.Hold({5}, {0}, {0});
  std::vector<double> f(1);
  pid.Step({0}, {0}, {0}, 0, f);
  EXPECT_EQ(f[0], 5);
  pid.Step({0}, {0}, {0}, 300, f);  // the integral is in newtons: no jump
  EXPECT_EQ(f[0], 5);
}

}  // namespace
}  // namespace ambrig
