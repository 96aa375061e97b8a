// What of the relative excess of the coils counts against its bands.
#include "fdd/commissioned/excess_ratios.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

constexpr int kSuspect = 2;

struct RatioBench {
  LinkageModel model = MakeLinkageModel(testing_bench::Reference());
  CommissionedBearing learnt = [this] {
    CommissionedBearing b = NominalBearing("A", model);
    b.learnt = true;
    return b;
  }();
  ExcessBands bands{model, learnt};
  ExcessRatios ratios{model, learnt};
  Lane gross_above;
  long long count = 100;

  RatioBench() {
    for (double& v : gross_above.v) v = ExcessLimits::kGross;
  }
  void Period(double excess, double weight) {
    SlopeExcess sums;
    for (int q = 0; q < 2; ++q)
      for (int j = 0; j < kLanes; ++j) {
        sums.bottom[q][j] = weight;
        sums.top[q][j] = j == kSuspect ? excess * weight : 0;
      }
    ratios.Update(sums, {bands, gross_above, false, false, count++});
  }
};

TEST(ExcessRatios, AGrossValueCountsWhereItIsMoreThanNoise) {
  RatioBench b;
  b.Period(0, 100);
  b.Period(-0.8, 100);
  EXPECT_GT(b.ratios.ratio()[kSuspect], 1);
  RatioBench noisy;
  noisy.Period(0, 3);
  noisy.Period(-0.8, 3);  // 1/sqrt(6) is the deviation of its c
  EXPECT_EQ(noisy.ratios.ratio()[kSuspect], 0);
  EXPECT_FALSE(noisy.ratios.calm());  // but it is looked at
}

// 160 periods with c = 0.06 stand out. Three of them that, in the noise, are below zero are no
// reading that is too low.
TEST(ExcessRatios, TheLastPeriodsAgreeWithWhatStandsOutOrNot) {
  RatioBench b;
  for (int n = 0; n < 160; ++n) b.Period(0.06, 2000);
  EXPECT_GT(b.ratios.ratio()[kSuspect], 1);
  EXPECT_TRUE(b.ratios.RecentAgrees(kSuspect));
  for (int n = 0; n < 3; ++n) b.Period(-0.02, 2000);
  EXPECT_GT(b.ratios.ratio()[kSuspect], 1);
  EXPECT_LT(b.ratios.Recent(kSuspect), 0);
  EXPECT_FALSE(b.ratios.RecentAgrees(kSuspect));
}

}  // namespace
}  // namespace ambrig
