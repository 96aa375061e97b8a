// A rig parameter that an effect's parameter can replace goes back to its drawing; one that nothing
// replaces stays.
#include "discovery/decision/pull_back.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/search/rig_prior.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kPlaceSd = 1e-3;  // [m] of the sensor's place
constexpr double kPullN = 1e5;     // independent numbers: information far above the prior's
constexpr double kZA = -0.12, kZB = 0.13;

/// A shaft held at +x in A and -x in B: the reading of A.x is x (1 - 2 (z_s - z_A)/(z_B - z_A)).
/// Where x is the same in all records, a place `shift` sd off and an offset of the sensor are the
/// same thing.
struct HeldTilted {
  HeldTilted(const std::vector<double>& x, double shift) : data(Make(x, shift)), model(data) {
    for (Target& t : model.targets()) t.floor = 4e-6;
  }
  static Case Make(const std::vector<double>& x, double shift) {
    Case c = LinearCase::Make(x, 1, 0);
    c.rig.tolerances = {{"bearings.A.sensor.z", kPlaceSd, kRequired}};
    const double z = c.rig.bearings[0].sensor.z + shift * kPlaceSd;
    for (std::size_t r = 0; r < x.size(); ++r) {
      c.records[r].scenario.clamp["B"] = {-x[r], 0};
      for (double& v : c.records[r].data.channels[0].samples)
        v = x[r] * (1 - 2 * (z - kZA) / (kZB - kZA));
    }
    return c;
  }
  /// The place where the data say, no offset, and a sensitivity to the place that errs by 5 %.
  FitResult Stuck(double shift) const {
    Hypothesis h = Hypothesis::Base(data.rig);
    h.AddEffect(LinearCase::Offset(0));
    h.Set(0, h.ValueAt(0, shift));
    FitOptions point;
    point.iterations = 0;
    point.effective_sample_size = kPullN;
    FitResult fit = Fit(model, h, point);
    fit.jacobian.col(0) *= 1.05;
    return fit;
  }
  const Case data;
  CaseModel model;
};

TEST(PullBack, WhatAnEffectCanReplaceGoesBackToItsDrawing) {
  const double shift = 3.5, x = 4e-5;
  const HeldTilted c({x, x, x, x}, shift);
  const FitResult stuck = c.Stuck(shift);
  ASSERT_NEAR(stuck.penalty, std::pow(PriorResidual(shift), 2), 1e-9);
  const PulledBack back = PullBack(c.model, stuck, kPullN);
  ASSERT_TRUE(back.moved);
  EXPECT_LT(std::abs(back.fit.hypothesis.Coordinate(0)), 1);
  EXPECT_LT(back.fit.penalty, 1);
  const double moved = shift - back.fit.hypothesis.Coordinate(0);
  // what the place made of the reading is now made by the offset; the sensitivity erred by 5 %
  EXPECT_NEAR(FittedEffect(back.fit, 0).Value("offset"), -2 * x * moved * kPlaceSd / (kZB - kZA),
              0.06 * 2 * x * moved * kPlaceSd / (kZB - kZA));
}

// The place shows in proportion to x, an offset does not.
TEST(PullBack, WhatTheRecordsTellStays) {
  const double shift = 3.5;
  const HeldTilted c({1e-4, -1e-4, 1.8e-4, 1.5e-4}, shift);
  const PulledBack back = PullBack(c.model, c.Stuck(shift), kPullN);
  EXPECT_FALSE(back.moved);
  EXPECT_NEAR(back.fit.hypothesis.Coordinate(0), shift, 1e-12);
}

TEST(PullBack, WithinItsToleranceNothingIsTried) {
  const HeldTilted c({4e-5, 4e-5, 4e-5, 4e-5}, 1.5);
  const FitResult fit = c.Stuck(1.5);
  const long before = c.model.runs;
  EXPECT_FALSE(PullBack(c.model, fit, kPullN).moved);
  EXPECT_EQ(c.model.runs, before);
}

}  // namespace
}  // namespace ambrig
