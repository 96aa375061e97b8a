// Mistakes put into data on purpose: each does what it says to one record and nothing to the
// others.
#include "discovery/practice/spoil.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/errors.h"
#include "core/math/noise.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

class SpoilTest : public ::testing::Test {
 protected:
  std::string Do(const std::string& fault, const std::string& channel = "A.x") {
    return Spoil(case_, 1, {fault, channel}, 5);
  }
  const std::vector<double>& Now(std::size_t channel, std::size_t record = 1) const {
    return case_.records[record].data.channels[channel].samples;
  }
  const std::vector<double>& Before(std::size_t channel, std::size_t record = 1) const {
    return clean_.records[record].data.channels[channel].samples;
  }
  /// All but the channel given are as before.
  void ExpectOthersUntouched(std::size_t spoilt) const {
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t ch = 0; ch < 4; ++ch)
        if (r != 1 || ch != spoilt) {
          EXPECT_EQ(Now(ch, r), Before(ch, r)) << r << " " << ch;
        }
  }

  const Case clean_ = MeasuredCase({{2e-5, 1e-5}, {-4e-5, 3e-5}, {5e-5, -2e-5}});
  Case case_ = clean_;
};

TEST_F(SpoilTest, UnitAndSignAreFactors) {
  EXPECT_EQ(Do("unit"), "record-2.h5: unit of A.x");
  for (std::size_t k = 0; k < 400; ++k) EXPECT_EQ(Now(0)[k], 1000 * Before(0)[k]);
  ExpectOthersUntouched(0);
  case_ = clean_;
  Do("sign");
  for (std::size_t k = 0; k < 400; ++k) EXPECT_EQ(Now(0)[k], -Before(0)[k]);
  ExpectOthersUntouched(0);
}

TEST_F(SpoilTest, AnAmountTakesThePlaceOfTheUsualOne) {
  EXPECT_EQ(Spoil(case_, 1, {"unit", "A.x", 25.4}, 5), "record-2.h5: unit of A.x");
  for (std::size_t k = 0; k < 400; ++k) EXPECT_EQ(Now(0)[k], 25.4 * Before(0)[k]);
  case_ = clean_;
  Spoil(case_, 1, {"lost", "", 0.1}, 5);
  EXPECT_EQ(Now(0).size(), 360U);
}

// The positions have an instrument of their own: nothing else is late.
TEST_F(SpoilTest, AnInstrumentIsLateInItsColumns) {
  Case c = clean_;
  std::vector<double> ramp(400);
  std::iota(ramp.begin(), ramp.end(), 0.0);
  c.records[1].data.channels.push_back({"A.i1", "A", ramp});
  const Case before = c;
  EXPECT_EQ(Spoil(c, 1, {"instrument", "", 0.004}, 5), "record-2.h5: all positions 0.004 s late");
  for (std::size_t ch = 0; ch < 5; ++ch) {
    const auto &now = c.records[1].data.channels[ch].samples,
               &was = before.records[1].data.channels[ch].samples;
    for (std::size_t k = 60; k < 400; ++k)
      EXPECT_EQ(now[k], ch < 4 ? was[k - 50] : was[k]) << ch << " " << k;
  }
}

// A record that is faster than the controller shows every reading twice.
TEST_F(SpoilTest, SignsOfNoiseDoNotShowInReadingsThatRepeat) {
  for (std::size_t k = 0; k < 400; ++k)
    case_.records[1].data.channels[0].samples[k] = 1e-7 * Normal(3, 0, k / 2);
  const CaseRecord before = case_.records[1];
  Do("sign");
  EXPECT_FALSE(ShowsMistake(before, case_.records[1]));
}

TEST_F(SpoilTest, WhatIsDoneShowsOrNot) {
  EXPECT_FALSE(ShowsMistake(clean_.records[1], case_.records[1]));
  Do("lag");  // of a shaft that is held
  EXPECT_FALSE(ShowsMistake(clean_.records[1], case_.records[1]));
  Do("sign");
  EXPECT_TRUE(ShowsMistake(clean_.records[1], case_.records[1]));
}

TEST_F(SpoilTest, SwappedColumnsAreOfOneBearing) {
  EXPECT_EQ(Do("swap"), "record-2.h5: A.x and A.y exchanged");
  EXPECT_EQ(Now(0), Before(1));
  EXPECT_EQ(Now(1), Before(0));
  EXPECT_EQ(Now(2), Before(2));
}

TEST_F(SpoilTest, AFrozenColumnStandsForAFewPerCentOfItsRows) {
  Do("freeze");
  std::size_t equal = 0;
  for (std::size_t k = 1; k < 400; ++k) equal += Now(0)[k] == Now(0)[k - 1] ? 1 : 0;
  EXPECT_EQ(equal, 59u);  // 60 rows of 400
  EXPECT_EQ(Now(0)[159], Before(0)[159]);
  EXPECT_EQ(Now(0)[220], Before(0)[220]);
  ExpectOthersUntouched(0);
}

TEST_F(SpoilTest, AClippedColumnEndsAtSixTenthsOfItsExtreme) {
  Do("clip", "A.y");  // positive
  const double top = 0.6 * *std::max_element(Before(1).begin(), Before(1).end());
  EXPECT_EQ(*std::max_element(Now(1).begin(), Now(1).end()), top);
  ExpectOthersUntouched(1);
}

TEST_F(SpoilTest, OneSampleIsOutOfRange) {
  Do("range");
  std::size_t changed = 0;
  for (std::size_t k = 0; k < 400; ++k) changed += Now(0)[k] != Before(0)[k] ? 1 : 0;
  EXPECT_EQ(changed, 1u);
  EXPECT_GT(Now(0)[133], 0.1);
}

// 20 ms at 12.5 kHz: 250 rows later, in all columns; the length stays.
TEST_F(SpoilTest, ALaggingRecordIsLateInAllColumns) {
  EXPECT_EQ(Do("lag"), "record-2.h5: all columns 0.02 s late");
  for (std::size_t ch = 0; ch < 4; ++ch) {
    ASSERT_EQ(Now(ch).size(), 400u);
    for (std::size_t k = 250; k < 400; ++k) EXPECT_EQ(Now(ch)[k], Before(ch)[k - 250]);
  }
}

// A burst of 400 rows at 360 kHz lasts 1.1 ms: it is late by two thirds of that.
TEST_F(SpoilTest, ABurstIsLateByAPartOfItself) {
  case_.records[1].data.rate = 360e3;
  Do("lag");
  for (std::size_t k = 266; k < 400; ++k) EXPECT_EQ(Now(0)[k], Before(0)[k - 266]);
}

TEST_F(SpoilTest, LostRowsAreGoneInAllColumns) {
  EXPECT_THAT(Do("lost"), HasSubstr("32 rows lost"));
  for (std::size_t ch = 0; ch < 4; ++ch) {
    ASSERT_EQ(Now(ch).size(), 368u);
    EXPECT_EQ(Now(ch)[179], Before(ch)[179]);
    EXPECT_EQ(Now(ch)[180], Before(ch)[212]);
  }
  for (const ChannelQuality& q : case_.records[1].quality) EXPECT_EQ(q.ok.size(), 368u);
}

TEST_F(SpoilTest, DataOfAnotherScenarioAreExchanged) {
  EXPECT_EQ(Do("scenario"), "data exchanged with those of record-1.h5");
  EXPECT_EQ(Now(0), Before(0, 0));
  EXPECT_EQ(Now(0, 0), Before(0));
}

// Without a channel one that moves is drawn, by the seed.
TEST_F(SpoilTest, TheSeedDrawsTheChannel) {
  const std::string first = Do("sign", "");
  case_ = clean_;
  EXPECT_EQ(Do("sign", ""), first);
  bool other = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Case again = clean_;
    other = other || Spoil(again, 1, {"sign", ""}, seed) != first;
  }
  EXPECT_TRUE(other);
}

// What is done to a column of nothing but noise is no mistake that could be seen.
TEST_F(SpoilTest, AColumnOfNoiseIsNotDrawn) {
  Case quiet = clean_;
  for (std::size_t k = 0; k < 400; ++k)
    quiet.records[1].data.channels[0].samples[k] = 1e-3 * Normal(11, 3, k);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Case again = quiet;
    EXPECT_THAT(Spoil(again, 1, {"sign", ""}, seed), ::testing::Not(HasSubstr("A.x")));
  }
}

TEST_F(SpoilTest, WhatCannotBeDoneIsRefused) {
  EXPECT_THROW(Do("rust"), InputError);
  EXPECT_THROW(Do("sign", "C.x"), InputError);
  EXPECT_THROW(Spoil(case_, 7, {"sign", ""}, 1), std::out_of_range);
}

}  // namespace
}  // namespace ambrig
