// Gain, correlation and shifts of columns whose truth is a formula.
#include "discovery/data/signal_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/math/noise.h"
#include "discovery/data/held_values.h"

namespace ambrig {
namespace {

double Wave(double k) { return 10 * std::sin(0.031 * k) + 6 * std::cos(0.0073 * k + 1); }

MatchedColumn Column(const std::function<double(long)>& measured, long rows = 3000) {
  MatchedColumn c;
  for (long k = 0; k < rows; ++k) {
    c.measured.push_back(measured(k) + 0.3 * Normal(9, 1, static_cast<std::uint64_t>(k)));
    c.predicted.push_back(Wave(static_cast<double>(k)));
    c.ok.push_back(1);
  }
  return c;
}

TEST(Match, GainAndCorrelation) {
  const Match m = MatchOf(Column([](long k) { return -1.7 * Wave(static_cast<double>(k)) + 4; }));
  EXPECT_NEAR(m.gain, -1.7, 0.01);
  EXPECT_LT(m.correlation, -0.99);
  const Match none = MatchOf(Column([](long) { return 4.0; }));
  EXPECT_NEAR(none.gain, 0, 0.01);
}

// As a column whose prediction was moved by hand.
TEST(Match, LaterIsThatOfAMovedPrediction) {
  const MatchedColumn c = Column([](long k) { return Wave(static_cast<double>(k - 20)); }, 500);
  for (const auto& [late, first] : {std::pair<long, long>{20, 0}, {20, 100}, {-7, 0}, {0, 0}}) {
    MatchedColumn moved = c;
    for (long k = first; k < 500; ++k) {
      const bool inside = k - late >= 0 && k - late < 500;
      const auto row = static_cast<std::size_t>(k);
      moved.predicted[row] = inside ? c.predicted[static_cast<std::size_t>(k - late)] : 0;
      moved.ok[row] = inside ? 1 : 0;
    }
    const Match expected = MatchOf(moved), found = MatchLater(c, late, first);
    EXPECT_EQ(found.error, expected.error) << late << " from " << first;
    EXPECT_EQ(found.correlation, expected.correlation);
  }
  EXPECT_LT(MatchLater(c, 20, 0).error, 0.35);  // the noise
}

TEST(BestShift, FindsALateRecord) {
  const auto column = Column([](long k) { return Wave(static_cast<double>(k - 137)); });
  const Shift s = BestShift({column}, 300);
  EXPECT_EQ(s.late, 137);
  EXPECT_LT(s.from, 140U);        // before, the edge is repeated
  EXPECT_LT(s.after, 1.1 * 0.3);  // the noise, of the rows that are predicted
}

TEST(BestShift, FindsWhereABlockIsMissing) {
  const auto column =
      Column([](long k) { return Wave(static_cast<double>(k < 1200 ? k : k + 90)); });
  const Shift s = BestShift({column}, 300);
  EXPECT_EQ(s.late, -90);
  EXPECT_NEAR(static_cast<double>(s.from), 1200, 3);
  EXPECT_LT(s.after, 1.1 * 0.3);
  EXPECT_GT(s.before, 3);
}

// Rows before anything moves tell no instant: shifted from the first row on they agree as well.
TEST(BestShift, SaysWhatAShiftOfAllRowsLeaves) {
  const auto begins = [](long k) { return k < 700 ? 0.0 : Wave(static_cast<double>(k - 700)); };
  MatchedColumn late = Column([&](long k) { return begins(k - 40); });
  for (std::size_t k = 0; k < late.size(); ++k) late.predicted[k] = begins(static_cast<long>(k));
  const Shift whole = BestShift({late}, 300);
  EXPECT_EQ(whole.late, 40);
  EXPECT_LT(whole.at_once, whole.after + 0.02 * whole.before);
  const Shift block = BestShift(
      {Column([](long k) { return Wave(static_cast<double>(k < 1200 ? k : k + 90)); })}, 300);
  EXPECT_GT(block.at_once, block.after + 0.5 * (block.before - block.after));
}

// What stands still and agrees is not shifted, although any shift agrees as well.
TEST(BestShift, LeavesAColumnThatStandsStillAlone) {
  MatchedColumn c;
  c.measured = c.predicted = std::vector<double>(3000, 4.0);
  c.ok.assign(3000, 1);
  EXPECT_EQ(BestShift({c}, 300).late, 0);
}

// A gain or an offset is no shift: little is won by any.
TEST(BestShift, LeavesOtherErrorsAlone) {
  const Shift s =
      BestShift({Column([](long k) { return 1.1 * Wave(static_cast<double>(k)) + 1; })}, 300);
  EXPECT_GT(s.after, 0.6 * s.before);
}

TEST(FrozenStretch, OnlyWhereAColumnUsuallyMoves) {
  std::vector<double> y(4000), coarse(4000);
  for (std::size_t k = 0; k < y.size(); ++k) {
    y[k] = Normal(2, 1, k);
    coarse[k] = std::floor(static_cast<double>(k) / 60);  // steps of 60 rows each
  }
  EXPECT_EQ(FrozenStretch(y).count, 0U);
  EXPECT_EQ(FrozenStretch(coarse).count, 0U);
  for (std::size_t k = 1000; k < 1200; ++k) y[k] = y[1000];
  EXPECT_EQ(FrozenStretch(y).first, 1000U);
  EXPECT_EQ(FrozenStretch(y).count, 200U);
}

}  // namespace
}  // namespace ambrig
