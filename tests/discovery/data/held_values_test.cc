// Columns that repeat a value: where, how often they usually do, and when that is a freeze.
#include "discovery/data/held_values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

std::vector<double> Moving(std::size_t rows) {
  std::vector<double> y(rows);
  for (std::size_t k = 0; k < rows; ++k) y[k] = std::sin(0.37 * static_cast<double>(k));
  return y;
}

/// `y` with `count` rows from `first` on held at the first of them.
std::vector<double> Held(std::vector<double> y, std::size_t first, std::size_t count) {
  for (std::size_t k = first; k < first + count; ++k) y[k] = y[first];
  return y;
}

TEST(HeldStretches, AreEqualNeighboursOfALeastLength) {
  const std::vector<double> y = {1, 1, 2, 3, 3, 3, 1, 4, 4};
  const auto two = HeldStretches(y, 2);
  ASSERT_EQ(two.size(), 3u);
  EXPECT_EQ(two[0].first, 0u);
  EXPECT_EQ(two[1].first, 3u);
  EXPECT_EQ(two[1].count, 3u);
  EXPECT_EQ(two[1].value, 3);
  EXPECT_EQ(two[2].first, 7u);  // to the column's end
  EXPECT_EQ(HeldStretches(y, 3).size(), 1u);
  EXPECT_EQ(HeldStretches(y, 1).size(), 5u);
  EXPECT_TRUE(HeldStretches({}, 1).empty());
}

// What is no number equals nothing, itself included: a gap is no freeze.
TEST(HeldStretches, AGapIsNone) {
  EXPECT_TRUE(HeldStretches(std::vector<double>(50, std::nan("")), 2).empty());
  EXPECT_EQ(FrozenStretch(Held(Moving(1000), 0, 5)).count, 0u);
}

TEST(UsualHold, IsOneWhereNothingRepeatsAndTheConvertersStepOtherwise) {
  EXPECT_EQ(UsualHold(Moving(500)), 1u);
  EXPECT_EQ(UsualHold({}), 1u);
  std::vector<double> stepped;
  for (const double v : Moving(200)) stepped.insert(stepped.end(), 6, v);
  EXPECT_EQ(UsualHold(stepped), 6u);
}

// A reading of 12.5 kHz in a record of 75 kHz; a converter's steps and a frozen logger are not
// regular.
TEST(RegularHold, IsThatOfAReadingThatAFasterRecordRepeats) {
  EXPECT_EQ(RegularHold(Moving(500)), 1u);
  std::vector<double> held;
  for (const double v : Moving(100)) held.insert(held.end(), 6, v);
  held.erase(held.begin(), held.begin() + 4);  // the record begins inside one
  EXPECT_EQ(RegularHold(held), 6u);
  EXPECT_EQ(RegularHold(std::vector<double>(held.begin(), held.begin() + 30)), 1u);  // too few
  std::vector<double> steps;
  for (std::size_t k = 0; k < 100; ++k) steps.insert(steps.end(), 1 + k % 7, 0.1 * (k % 5));
  EXPECT_EQ(RegularHold(steps), 1u);
  EXPECT_EQ(RegularHold(Held(Moving(1000), 300, 400)), 1u);
}

TEST(FrozenStretch, IsFarLongerThanTheUsualOnes) {
  const HeldStretch frozen = FrozenStretch(Held(Moving(1000), 300, 40));
  EXPECT_EQ(frozen.first, 300u);
  EXPECT_EQ(frozen.count, 40u);
  EXPECT_EQ(frozen.value, Moving(301)[300]);
  EXPECT_EQ(FrozenStretch(Held(Moving(1000), 300, 19)).count, 0u);
}

// Where the converter holds each value for six rows, sixty rows are nothing unusual, two hundred
// are.
TEST(FrozenStretch, OfAStepwiseColumnMustBeLonger) {
  std::vector<double> stepped;
  for (const double v : Moving(400)) stepped.insert(stepped.end(), 6, v);
  EXPECT_EQ(FrozenStretch(Held(stepped, 600, 60)).count, 0u);
  EXPECT_EQ(FrozenStretch(Held(stepped, 600, 200)).count, 200u);
}

TEST(FrozenStretch, OfTwoIsTheLonger) {
  EXPECT_EQ(FrozenStretch(Held(Held(Moving(2000), 100, 30), 900, 70)).first, 900u);
}

// A set-point that rests for nearly all of a record may do so.
TEST(FrozenStretch, AColumnAtRestHasNone) {
  EXPECT_EQ(FrozenStretch(Held(Moving(1000), 0, 950)).count, 0u);
  EXPECT_EQ(FrozenStretch(std::vector<double>(1000, 2)).count, 0u);
  EXPECT_EQ(FrozenStretch(Held(Moving(1000), 0, 800)).count, 800u);
}

}  // namespace
}  // namespace ambrig
