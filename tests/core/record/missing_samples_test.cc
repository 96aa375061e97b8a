#include "core/record/missing_samples.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace ambrig {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInf = std::numeric_limits<double>::infinity();

Record Logged(std::vector<double> x, std::vector<double> y) {
  return {.rate = 100, .channels = {{"x", "m", std::move(x)}, {"y", "m", std::move(y)}}};
}

bool All(const std::string&) { return true; }

TEST(MissingSamples, StraightLinesOverGapsAndHeldEnds) {
  const BridgedRecord b =
      BridgeMissing(Logged({kNan, 1, kNan, kInf, 4, kNan}, {0, 1, 2, 3, 4, 5}), 0, All);
  EXPECT_THAT(b.record.channels[0].samples, ::testing::ElementsAre(1, 1, 2, 3, 4, 4));
  EXPECT_THAT(b.record.channels[1].samples, ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(b.in_gap, ::testing::ElementsAre(1, 0, 1, 1, 0, 1));
}

TEST(MissingSamples, AGapIsFeltForAWhile) {
  const BridgedRecord b =
      BridgeMissing(Logged({0, kNan, 2, 3, 4, 5}, {0, 0, 0, 0, kNan, 0}), 0.02, All);
  EXPECT_THAT(b.in_gap, ::testing::ElementsAre(0, 1, 1, 1, 1, 1));
  EXPECT_TRUE(b.Sound(0));
  EXPECT_FALSE(b.Sound(3));
}

TEST(MissingSamples, OnlyWhatDrivesMakesAGap) {
  const BridgedRecord b = BridgeMissing(Logged({0, kNan, 2}, {kNan, 1, 2}), 0,
                                        [](const std::string& name) { return name == "x"; });
  EXPECT_THAT(b.record.channels[1].samples, ::testing::ElementsAre(1, 1, 2));
  EXPECT_THAT(b.in_gap, ::testing::ElementsAre(0, 1, 0));
}

TEST(MissingSamples, NothingMissingNothingChanged) {
  const BridgedRecord b = BridgeMissing(Logged({1, 2}, {3, 4}), 1, All);
  EXPECT_TRUE(b.in_gap.empty());
  EXPECT_TRUE(b.Sound(1));
}

TEST(MissingSamples, AChannelWithoutAnySampleIsLeftOut) {
  const BridgedRecord b = BridgeMissing(Logged({kNan, kNan}, {3, 4}), 0, All);
  ASSERT_EQ(b.record.channels.size(), 1U);
  EXPECT_EQ(b.record.channels[0].name, "y");
}

}  // namespace
}  // namespace ambrig
