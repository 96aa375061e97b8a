// Every hand-over arrives; each keeps what its name promises on the way.
#include "faulttolerance/supervision/current_transition_policy.h"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "core/math/constants.h"
#include "faulttolerance/redistribution/network_force.h"
#include "tests/faulttolerance/redistribution_reference.h"

namespace ambrig {
namespace {

struct Way {
  TransitionStart start;
  CoilVector wanted;
  Eigen::Vector2d force;
};

/// One open coil of the reference bearing: W - 1 W_f (published_values.md 2.1) under a force of 12
/// N.
Way CoilOneOpens() {
  Way w;
  TransitionStart& s = w.start;
  s.bearing = MakeRedistributionProblem(std::numbers::pi / 8, "NSNSNSNS");
  const DistributionMatrix healthy = HealthyDistribution(s.bearing);
  DistributionMatrix left = s.bearing.sign.asDiagonal() * (healthy);
  const Eigen::RowVector3d lost = left.row(0);
  left.rowwise() -= lost;
  left = s.bearing.sign.asDiagonal() * left;
  const double unit = ForceFactor(s.bearing) * 2;
  const Eigen::Vector3d command(2, 6 / unit, 10.4 / unit);
  s.now = healthy * command;
  s.now[0] = 0;
  s.bearing.turns_left[0] = 0;
  s.bearing.quadrants = 4;
  s.bias_before = 2 * healthy.col(0);
  s.bias_after = 2 * left.col(0);
  s.leakage = 3.5e-4;
  s.voltage = 24;
  s.period = 80e-6;
  w.wanted = left * command;
  w.force = {6, 10.4};
  return w;
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  std::stringstream list(kCurrentTransitionNames);
  for (std::string one; std::getline(list, one, ',');) names.push_back(one);
  return names;
}

// L_jj = P N² (1 - 1/8) + L_l of every coil, -P N²/8 between two of opposite winding (with the
// signs +): P = mu0 A/g.
TEST(CurrentTransition, InductanceOfTheCoupledCoils) {
  TransitionStart s = CoilOneOpens().start;
  s.bearing.turns_left.setOnes();
  const RedistributionProblem& b = s.bearing;
  const double own = kMu0 * b.pole_area / b.gap * b.turns * b.turns;
  const CoilForm L = InductanceOf(s);
  const CoilVector step = RampStep(s);
  for (int j = 0; j < 8; ++j) {
    EXPECT_NEAR(L(j, j), own * 7 / 8 + s.leakage, 1e-12 * own);
    EXPECT_NEAR(L(j, (j + 1) % 8), own / 8, 1e-12 * own);  // opposite winding
    EXPECT_NEAR(L(j, (j + 2) % 8), -own / 8, 1e-12 * own);
    EXPECT_NEAR(step[j], s.voltage * s.period / (own * 7 / 8 + s.leakage), 1e-12);
  }
  for (int lost = 0; lost < 8; ++lost) {
    s.bearing.turns_left.setOnes();
    s.bearing.turns_left[lost] = 0;
    const CoilForm without = InductanceOf(s);
    EXPECT_EQ(without(lost, lost), 1);
    EXPECT_EQ(without.row(lost).squaredNorm(), 1);
  }
  s.bearing.turns_left.setConstant(0.5);
  EXPECT_NEAR(InductanceOf(s)(0, 0), 0.25 * L(0, 0), 1e-12 * own);
}

TEST(CurrentTransition, EveryPolicyArrivesAndThenHandsThrough) {
  const Way w = CoilOneOpens();
  for (const std::string& name : Names()) {
    const auto policy = MakeCurrentTransition(name, w.start);
    int steps = 0;
    CoilVector at = w.start.now;
    while (steps < 100 && (steps == 0 || !policy->done())) {
      at = policy->Step(w.wanted, w.force);
      ++steps;
    }
    EXPECT_NEAR((at - w.wanted).norm(), 0, 1e-9) << name;
    EXPECT_LE(steps, 12) << name;
    const CoilVector other = 1.1 * w.wanted;
    EXPECT_EQ(policy->Step(other, w.force), other) << name;
  }
}

TEST(CurrentTransition, NoCoilOfTheRampGoesFasterThanItsVoltageAllows) {
  const Way w = CoilOneOpens();
  const CoilVector step = RampStep(w.start);
  EXPECT_NEAR(step[1], 24 * 80e-6 / 1.75e-3, 1e-3);  // docs/theory/base_model.md: 1.75 mH
  for (const char* name : {"ramp", "bias-first", "force-preserving"}) {
    const auto policy = MakeCurrentTransition(name, w.start);
    CoilVector last = w.start.now;
    for (int n = 0; n < 12 && !policy->done(); ++n) {
      const CoilVector now = policy->Step(w.wanted, w.force);
      for (int j = 0; j < 8; ++j)
        EXPECT_LE(std::abs(now[j] - last[j]), step[j] + 1e-9) << name << " coil " << j + 1;
      last = now;
    }
  }
}

TEST(CurrentTransition, TimeOptimalKeepsOneCoilAtTheLimitAndNoneBeyond) {
  const Way w = CoilOneOpens();
  const auto policy = MakeCurrentTransition("time-optimal", w.start);
  const CoilForm L = InductanceOf(w.start);
  CoilVector last = w.start.now;
  while (!policy->done()) {
    const CoilVector now = policy->Step(w.wanted, w.force);
    CoilVector volts = L * (now - last) / w.start.period;
    volts[0] = 0;  // open
    EXPECT_LE(volts.cwiseAbs().maxCoeff(), 24 + 1e-9);
    if (!policy->done()) {
      EXPECT_NEAR(volts.cwiseAbs().maxCoeff(), 24, 1e-9);
    }
    last = now;
  }
}

TEST(CurrentTransition, ForceIsKeptOnTheWayWhereARampLosesIt) {
  const Way w = CoilOneOpens();
  const NetworkForce network(w.start.bearing);
  const auto worst = [&](const char* name) {
    const auto policy = MakeCurrentTransition(name, w.start);
    double most = 0;
    policy->Step(w.wanted, w.force);
    while (!policy->done())
      most = std::max(most, (network.Force(policy->Step(w.wanted, w.force)) - w.force).norm());
    return most;
  };
  EXPECT_LT(worst("force-preserving"), 0.5 * worst("ramp"));
}

}  // namespace
}  // namespace ambrig
