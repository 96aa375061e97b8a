// Records compared: a changed gain, a shift in time, a lost channel, a NaN, another rate.
#include "core/record/record_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ambrig {
namespace {

/// x = sin(2 pi 10 t) and y = 0.5 cos(2 pi 10 t) over a second, in metres.
Record Waves(double rate, double gain = 1, double shift = 0) {
  Record r;
  r.rate = rate;
  const auto rows = static_cast<std::size_t>(rate);
  r.channels = {{"A.x", "m", {}}, {"A.y", "m", {}}};
  for (std::size_t k = 0; k < rows; ++k) {
    const double phase = 2 * M_PI * 10 * (static_cast<double>(k) / rate - shift);
    r.channels[0].samples.push_back(gain * std::sin(phase));
    r.channels[1].samples.push_back(0.5 * std::cos(phase));
  }
  return r;
}

RecordTolerances OnAllChannels(double absolute, double relative, double time) {
  RecordTolerances t;
  t.all = {absolute, relative, time};
  return t;
}

TEST(RecordDifference, SameRecordDiffersInNoBit) {
  const RecordDifference d = CompareRecords(Waves(1000), Waves(1000), {});
  EXPECT_TRUE(d.identical());
  EXPECT_TRUE(d.agrees());
  EXPECT_EQ(d.First(), nullptr);
}

TEST(RecordDifference, GainOfOnePerCent) {
  const Record a = Waves(1000), b = Waves(1000, 1.01);
  const RecordDifference strict = CompareRecords(a, b, OnAllChannels(0, 0.005, 0));
  EXPECT_FALSE(strict.agrees());
  ASSERT_NE(strict.First(), nullptr);
  EXPECT_EQ(strict.First()->channel, "A.x");
  EXPECT_NEAR(strict.First()->worst, 0.01, 1e-12);      // at the crest
  EXPECT_NEAR(strict.First()->worst_at, 0.025, 1e-12);  // a quarter of a period
  EXPECT_NEAR(strict.First()->rms, 0.01 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(strict.First()->first, std::asin(0.5) / (2 * M_PI * 10), 1e-3);
  EXPECT_TRUE(CompareRecords(a, b, OnAllChannels(0, 0.0101, 0)).agrees());
  EXPECT_TRUE(CompareRecords(a, b, OnAllChannels(0.0101, 0, 0)).agrees());
  EXPECT_FALSE(CompareRecords(a, b, OnAllChannels(0.0101, 0, 0)).identical());
}

TEST(RecordDifference, ShiftInTime) {
  const Record a = Waves(1000), b = Waves(1000, 1, 0.002);
  EXPECT_FALSE(CompareRecords(a, b, OnAllChannels(1e-3, 0, 0)).agrees());
  EXPECT_FALSE(CompareRecords(a, b, OnAllChannels(1e-3, 0, 0.001)).agrees());
  EXPECT_TRUE(CompareRecords(a, b, OnAllChannels(1e-2, 0, 0.002)).agrees());
}

TEST(RecordDifference, OneBitIsNotTheSame) {
  const Record a = Waves(1000);
  Record b = a;
  b.channels[1].samples[400] = std::nextafter(b.channels[1].samples[400], 1.0);
  const RecordDifference d = CompareRecords(a, b, {});
  EXPECT_FALSE(d.agrees());
  EXPECT_EQ(d.First()->channel, "A.y");
  EXPECT_DOUBLE_EQ(d.First()->first, 0.4);
  EXPECT_EQ(d.First()->beyond, 1U);
}

TEST(RecordDifference, LostAndNewChannelNanAndUnit) {
  const Record a = Waves(1000);
  Record b = a;
  b.channels[0].name = "B.x";
  const RecordDifference lost = CompareRecords(a, b, OnAllChannels(1, 1, 1));
  EXPECT_EQ(lost.channels[0].verdict, ChannelVerdict::kLost);
  EXPECT_EQ(lost.channels[2].verdict, ChannelVerdict::kNew);
  EXPECT_FALSE(lost.agrees());
  b = a;
  b.channels[0].samples[7] = std::numeric_limits<double>::quiet_NaN();
  const RecordDifference nan = CompareRecords(a, b, OnAllChannels(1, 1, 1));
  EXPECT_EQ(nan.First()->verdict, ChannelVerdict::kNan);
  EXPECT_DOUBLE_EQ(nan.First()->first, 0.007);
  EXPECT_TRUE(CompareRecords(b, b, {}).identical());  // a gap that both have
  b = a;
  b.channels[0].unit = "A";
  EXPECT_EQ(CompareRecords(a, b, OnAllChannels(1, 1, 1)).channels[0].verdict,
            ChannelVerdict::kOtherUnit);
}

TEST(RecordDifference, OtherRateIsComparedAtTheFirstOnesRows) {
  // Every tenth row kept: the rows coincide, nothing differs.
  const RecordDifference d = CompareRecords(Waves(100), Waves(1000), {});
  EXPECT_EQ(d.channels[0].rows, 100U);
  EXPECT_LT(d.channels[0].worst, 1e-12);  // phases are computed from either rate
  EXPECT_TRUE(CompareRecords(Waves(100), Waves(1000), OnAllChannels(1e-12, 0, 0)).agrees());
}

TEST(RecordDifference, ShorterRecordIsNamed) {
  Record b = Waves(1000);
  for (Channel& c : b.channels) c.samples.resize(900);
  const RecordDifference d = CompareRecords(Waves(1000), b, {});
  EXPECT_FALSE(d.agrees());
  EXPECT_EQ(d.length, "ends at 0.9 s, was 1 s");
}

TEST(RecordDifference, LastPatternCounts) {
  RecordTolerances t = OnAllChannels(1, 0, 0);
  t.patterns = {{"A.*", {2, 0, 0}}, {"A.i*", {3, 0, 0}}};
  EXPECT_EQ(t.Of("bus").absolute, 1);
  EXPECT_EQ(t.Of("A.x").absolute, 2);
  EXPECT_EQ(t.Of("A.i7").absolute, 3);
}

}  // namespace
}  // namespace ambrig
