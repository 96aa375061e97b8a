// Bands: how wide they are, and what leaves them.
#include "discovery/watch/record_state.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

RecordState State(double gap, double sd, double ratio) {
  RecordState s;
  s.ratio = s.ratio_fitted = ratio;
  s.effective_sample_size = 1e4;
  s.noise["A.x"] = 1e-7;
  s.parameters = {{"bearings.A.gap", "m", gap, sd}, {"rotor.mass", "kg", 4.2, 0.01}};
  return s;
}

// Quantiles of the normal distribution: 99 % of one, of ten (1 - 0.01/10, two-sided).
TEST(RecordBands, KeepNinetyNineOfAHundredUnchangedRecords) {
  EXPECT_NEAR(BandWidth(1), 2.5758, 1e-4);
  EXPECT_NEAR(BandWidth(10), 3.2905, 1e-4);
  const LeftBand b = ParameterBand({"p", "m", 5, 0.3}, {"p", "m", 4, 0.4}, 1);
  EXPECT_NEAR(b.sds, 2, 1e-12);  // 1 over the sd of both, 0.5
  EXPECT_NEAR(b.greatest - b.was, 2.5758 * 0.5, 1e-4);
}

TEST(RecordBands, AParameterLeavesThemByTheSdOfBoth) {
  const RecordState was = State(4e-4, 1e-6, 1);
  EXPECT_TRUE(FindLeftBands(State(4.035e-4, 1e-6, 1), was).empty());  // 2.5 sd, band of two: 2.81
  const auto left = FindLeftBands(State(4.05e-4, 1e-6, 1), was);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].kind, "parameter");
  EXPECT_EQ(left[0].name, "bearings.A.gap");
  EXPECT_NEAR(left[0].sds, 5 / std::sqrt(2.0), 1e-9);
  // One that says little has a wide band.
  EXPECT_TRUE(FindLeftBands(State(4.05e-4, 4e-6, 1), was).empty());
}

TEST(RecordBands, TheErrorLeavesThemWhenItRisesByMoreThanChance) {
  const RecordState was = State(4e-4, 1e-6, 1.7);
  EXPECT_TRUE(FindLeftBands(State(4e-4, 1e-6, 1.8), was).empty());
  const auto left = FindLeftBands(State(4e-4, 1e-6, 2.0), was);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].kind, "error");
  EXPECT_TRUE(FindLeftBands(State(4e-4, 1e-6, 1.0), was).empty());  // a fall is no alarm
  RecordState few = State(4e-4, 1e-6, 2.0);
  few.effective_sample_size = 30;  // rms of 30 numbers: 1 + 2.58/sqrt(30) = 1.47
  EXPECT_TRUE(FindLeftBands(few, was).empty());
}

TEST(RecordBands, NoiseLeavesThemByHalfOfItself) {
  const RecordState was = State(4e-4, 1e-6, 1);
  RecordState now = was;
  now.noise["A.x"] = 1.4e-7;
  EXPECT_TRUE(FindLeftBands(now, was).empty());
  now.noise["A.x"] = 1.6e-7;
  ASSERT_EQ(FindLeftBands(now, was).size(), 1u);
  EXPECT_EQ(FindLeftBands(now, was)[0].kind, "noise");
  now.noise = {{"B.x", 1}};  // a channel that the reference did not have
  EXPECT_TRUE(FindLeftBands(now, was).empty());
}

// A channel that says nothing any more cannot differ from the model: that it is gone is told by
// itself.
TEST(RecordBands, AChannelThatIsGoneLeavesThem) {
  RecordState was = State(4e-4, 1e-6, 1);
  was.floors = {{"A.x", 1}, {"A.y", 1}};
  RecordState now = was;
  EXPECT_TRUE(FindLeftBands(now, was).empty());
  now.floors.erase("A.y");
  const auto left = FindLeftBands(now, was);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].kind, "channel");
  EXPECT_EQ(left[0].name, "A.y");
  EXPECT_TRUE(std::isnan(left[0].value));
}

}  // namespace
}  // namespace ambrig
