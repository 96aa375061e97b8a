#include "core/math/cvode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace ambrig {
namespace {

std::unique_ptr<OdeSolver> Make(bool stiff, const OdeProblem& p) {
  if (stiff) return std::make_unique<Cvode>(p);
  return std::make_unique<Arkode>(p, 5);
}

class Integrators : public ::testing::TestWithParam<bool> {};

// y' = -k (y - cos t) - sin t has y = cos t; the global error of a damped problem stays near the
// local tolerance (BDF adds up some hundred steps of it).
TEST_P(Integrators, FollowsAClosedForm) {
  OdeProblem p;
  p.size = 1;
  p.rhs = [](double t, const double* y, double* f) {
    f[0] = -50 * (y[0] - std::cos(t)) - std::sin(t);
  };
  p.relative = 1e-10;
  p.absolute = {1e-12};
  const auto solver = Make(GetParam(), p);
  std::vector<double> y = {1};
  solver->Restart(0, y, 1e-3);
  for (double t : {0.1, 0.5, 2.0}) {
    const auto out = solver->Advance(t, y);
    EXPECT_FALSE(out.root);
    EXPECT_EQ(out.t, t);
    EXPECT_NEAR(y[0], std::cos(t), 1e-8);
  }
}

// Free fall from 1 m: the floor is met at sqrt(2/g), exactly a parabola.
TEST_P(Integrators, FindsTheRootInItsDirection) {
  OdeProblem p;
  p.size = 2;
  p.rhs = [](double, const double* y, double* f) {
    f[0] = y[1];
    f[1] = -9.81;
  };
  p.roots = 2;
  p.root = [](double, const double* y, double* g) { g[0] = g[1] = y[0] - 1; };
  p.directions = {1, -1};  // the way up and the way down through 1 m
  p.absolute = {1e-13, 1e-13};
  const auto solver = Make(GetParam(), p);
  std::vector<double> y = {0, 6};
  solver->Restart(0, y, 1e-3);
  auto out = solver->Advance(2, y);
  ASSERT_TRUE(out.root);
  const double up = (6 - std::sqrt(36 - 2 * 9.81)) / 9.81,
               down = (6 + std::sqrt(36 - 2 * 9.81)) / 9.81;
  EXPECT_NEAR(out.t, up, 1e-9);
  EXPECT_EQ(solver->roots()[0], 1);
  EXPECT_EQ(solver->roots()[1], 0);
  out = solver->Advance(2, y);
  ASSERT_TRUE(out.root);
  EXPECT_NEAR(out.t, down, 1e-9);
  EXPECT_EQ(solver->roots()[1], -1);
  out = solver->Advance(2, y);
  EXPECT_FALSE(out.root);
}

// The same solver goes on after a restart with another right-hand side state (a bounce).
TEST_P(Integrators, RestartsAfterAnEvent) {
  OdeProblem p;
  p.size = 2;
  p.rhs = [](double, const double* y, double* f) {
    f[0] = y[1];
    f[1] = -9.81;
  };
  p.roots = 1;
  p.root = [](double, const double* y, double* g) { g[0] = y[0]; };
  p.directions = {-1};
  p.absolute = {1e-13, 1e-13};
  const auto solver = Make(GetParam(), p);
  std::vector<double> y = {1, 0};
  double t = 0;
  solver->Restart(t, y, 1e-2);
  for (int bounce = 0; bounce < 3; ++bounce) {
    const auto out = solver->Advance(10, y);
    ASSERT_TRUE(out.root);
    const double fall = std::sqrt(2 / 9.81);
    EXPECT_NEAR(out.t, fall + 2 * bounce * fall, 1e-8);
    t = out.t;
    y[0] = 0;
    y[1] = -y[1];
    solver->Restart(t, y, 1e-2);
  }
}

TEST_P(Integrators, WhatTheRightHandSideThrowsComesOut) {
  OdeProblem p;
  p.size = 1;
  p.rhs = [](double t, const double*, double* f) {
    if (t > 0.5) throw std::domain_error("beyond one half");
    f[0] = 1;
  };
  p.absolute = {1e-9};
  const auto solver = Make(GetParam(), p);
  std::vector<double> y = {0};
  solver->Restart(0, y, 1e-3);
  EXPECT_THROW(solver->Advance(1, y), std::domain_error);
}

TEST_P(Integrators, AFailureSaysWhy) {
  OdeProblem p;
  p.size = 1;
  p.rhs = [](double, const double* y, double* f) { f[0] = y[0] * y[0]; };  // infinite at t = 1
  p.absolute = {1e-12};
  p.max_steps = 500;
  const auto solver = Make(GetParam(), p);
  std::vector<double> y = {1};
  solver->Restart(0, y, 1e-3);
  try {
    solver->Advance(2, y);
    FAIL() << "expected a failure";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(GetParam() ? "CVODE" : "ARKODE"), std::string::npos)
        << e.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Integrators, ::testing::Bool(),
                         [](const auto& which) { return which.param ? "Cvode" : "Arkode"; });

// Observed order: halving fixed-size segments of one step each divides the error by 2^order.
TEST(Arkode, HasTheOrderAskedFor) {
  for (int order : {3, 5}) {
    double error[2];
    for (int k = 0; k < 2; ++k) {
      OdeProblem p;
      p.size = 1;
      p.rhs = [](double, const double* y, double* f) { f[0] = y[0]; };
      p.relative = 1;  // one step per segment, whatever its error
      p.absolute = {1};
      Arkode solver(p, order);
      const int segments = 4 << k;
      std::vector<double> y = {1};
      for (int s = 0; s < segments; ++s) {
        const double a = static_cast<double>(s) / segments, b = (s + 1.0) / segments;
        solver.Restart(a, y, b - a);
        solver.Advance(b, y);
        EXPECT_EQ(solver.steps(), 1);
      }
      error[k] = std::abs(y[0] - std::exp(1));
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), order, 0.35) << "order " << order;
  }
}

}  // namespace
}  // namespace ambrig
