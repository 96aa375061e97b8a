// The control chart by hand: sums of both phases and of their difference, steps between periods,
// and the expected size of a residual.
#include "fdd/measurement/residual_chart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fdd/circuit/inductance_matrix.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

ResidualChart With(double on, double off) {
  ResidualChart c;
  for (int j = 0; j < kLanes; ++j) {
    c.z[0][j] = on;
    c.z[1][j] = off;
    c.valid[0][j] = c.valid[1][j] = 1;
  }
  return c;
}

TEST(ResidualChart, SumsWhatExceedsTheDrift) {
  const ChartSettings s;  // drift 2.5, cap 12
  ResidualChart c = With(3, -4);
  EXPECT_NEAR(c.Cusum(s), 7 * 0.7071 - 2.5, 1e-12);
  EXPECT_NEAR(c.G[0][0], 0.5, 1e-12);
  EXPECT_NEAR(c.G[1][7], 1.5, 1e-12);
  EXPECT_NEAR(c.Cusum(s), 2 * (7 * 0.7071 - 2.5), 1e-12);
  EXPECT_NEAR(c.LargestSum(), 2 * (7 * 0.7071 - 2.5), 1e-12);
  EXPECT_EQ(c.LargestResidual(), 4);
}

TEST(ResidualChart, SumsNeverFallBelowZeroAndOneResidualCountsNoMoreThanTheCap) {
  const ChartSettings s;
  ResidualChart c = With(1, 1);
  c.G[0][0] = 2;
  EXPECT_NEAR(c.Cusum(s), 0.5, 1e-12);
  EXPECT_NEAR(c.G[0][0], 0.5, 1e-12);
  EXPECT_EQ(c.G[1][0], 0);
  ResidualChart large = With(-1e6, 0);
  EXPECT_NEAR(large.Cusum(s), 12 - 2.5, 1e-12);
}

TEST(ResidualChart, APhaseThatDoesNotHoldLeavesItsSumsAlone) {
  const ChartSettings s;
  ResidualChart c = With(5, 5);
  c.valid[1][4] = 0;
  for (Lane& g : c.G) g[4] = 1;
  c.Cusum(s);
  EXPECT_NEAR(c.G[0][4], 1 + 2.5, 1e-12);
  EXPECT_EQ(c.G[1][4], 1);
  EXPECT_EQ(c.G[2][4], 1);  // a difference needs both
  EXPECT_NEAR(c.G[1][3], 2.5, 1e-12);
}

// |change per second - expected| against limit (noise L + floor).
TEST(ResidualChart, AStepIsSeenBeyondItsNoise) {
  ResidualChart c;
  for (double& L : c.own.v) L = 2e-3;
  Lane before, after, expected;
  for (int j = 0; j < kLanes; ++j) {
    before[j] = 0.01;
    after[j] = 0.01 + 1e-5;
    expected[j] = 4;
  }
  LinkageStep step{&before, &after, &expected, 1e6, 500, 0.2};
  // 10 - 4 V; noise 500 x 2e-3 + 0.2 = 1.2 V
  EXPECT_TRUE(c.Steps(step, 4.9));
  EXPECT_FALSE(c.Steps(step, 5.1));
  after[6] = 0.01 - 1e-5;  // -10 - 4 in one coil
  EXPECT_TRUE(c.Steps(step, 11.5));
  EXPECT_FALSE(c.Steps(step, 11.8));
}

class OnTheBench : public ::testing::Test {
 protected:
  testing_bench::Bench bench_;
  LinkageModel model_ = MakeLinkageModel(testing_bench::Reference());
  ChartSettings settings_;
  PeriodSlopes slopes_;

  ResidualChart Computed(const Lane& watched, const Lane* uncertainty = nullptr,
                         const ModelError& known = {}) {
    ResidualChart c;
    c.Compute(model_, bench_.Sampling(), settings_, known, slopes_, watched, uncertainty, 0);
    return c;
  }
  void SetUp() override {
    for (int k = 0; k < 50; ++k)
      ComputePeriodSlopes(model_, bench_.Sampling(), bench_.Run(), &slopes_);
    for (double& w : all_.v) w = 1;
  }
  Lane all_;
};

// The healthy stator obeys the equation: residuals far below their size.
TEST_F(OnTheBench, HealthyResidualsAreSmall) {
  const ResidualChart c = Computed(all_);
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) {
      EXPECT_EQ(c.valid[q][j], 1);
      EXPECT_LT(std::abs(c.z[q][j]), 0.5);
    }
}

// Of noise s [A] per sample: (L s)² scale/h, and the voltage's own uncertainty; the root is good to
// 5e-6.
TEST_F(OnTheBench, TheExpectedSizeIsThatOfNoiseAndVoltage) {
  const ResidualChart c = Computed(all_);
  const LinkageMatrix L = InductanceOf(model_, slopes_.permeance.middle);
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) {
      EXPECT_NEAR(c.own[j], L(j, j), 1e-4 * L(j, j));  // the sum at the middle, not of the middles
      const double noise = c.own[j] * settings_.current_noise;
      const double sd =
          std::sqrt(noise * noise * slopes_.phase[q].scale[j] / bench_.Sampling().step +
                    settings_.voltage_sd * settings_.voltage_sd);
      EXPECT_NEAR(c.sd[q][j], sd, 2e-5 * sd);
      EXPECT_NEAR(c.per_sd[q][j], 1 / sd, 2e-5 / sd);
      EXPECT_NEAR(c.z[q][j], c.e[q][j] / sd, 2e-5 * std::abs(c.e[q][j] / sd));
    }
}

TEST_F(OnTheBench, OnlyWatchedCoilsCount) {
  Lane some = all_;
  some[3] = 0;
  const ResidualChart c = Computed(some);
  EXPECT_EQ(c.valid[0][3], 0);
  EXPECT_EQ(c.z[0][3], 0);
  EXPECT_EQ(c.valid[0][2], 1);
}

// What the motion may add makes every residual wider, and what is known of the model is taken out.
TEST_F(OnTheBench, UncertaintyWidensAndKnowledgeCorrects) {
  Lane motion;
  for (double& u : motion.v) u = 30;
  const ResidualChart plain = Computed(all_), wide = Computed(all_, &motion);
  ModelError known;
  known.leakage = 1e-5;
  const ResidualChart corrected = Computed(all_, nullptr, known);
  for (int j = 0; j < kLanes; ++j) {
    EXPECT_GT(wide.sd[0][j], plain.sd[0][j]);
    EXPECT_LE(std::abs(wide.z[0][j]), std::abs(plain.z[0][j]));
    // e = -(leakage error) di: taken out, + 1e-5 di
    EXPECT_NEAR(corrected.e[0][j] - plain.e[0][j], 1e-5 * slopes_.phase[0].current[j],
                1e-9 + 1e-6 * std::abs(plain.e[0][j]));
  }
}

}  // namespace
}  // namespace ambrig
