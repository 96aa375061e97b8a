// Nuisances: what they take off a residual in closed form, and which of them a residual asks for.
#include "discovery/decision/nuisance_choice.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using Eigen::Index;

class NuisanceChoiceTest : public ::testing::Test {
 protected:
  /// A kind that is `size` floors in every row of a channel (0: A.x, 1: A.y), all records.
  NuisanceKind Zero(std::size_t channel, double size = 10) const {
    NuisanceKind k;
    k.name = channel == 0 ? "zero of A.x" : "zero of A.y";
    k.group = NuisanceGroup::kSensorZero;
    k.unit = "m";
    k.sd = size * LinearCase::kFloor;
    k.column = StretchColumn(static_cast<Index>(case_.model.size()));
    for (const Target& t : case_.model.targets())
      if (t.channel == channel)
        k.column.Append(static_cast<Index>(t.first),
                        Eigen::VectorXd::Constant(static_cast<Index>(t.count), size));
    return k;
  }
  /// `of_record[r]` floors in A.x of record r.
  std::vector<double> Offsets(const std::vector<double>& of_record) const {
    std::vector<double> r(case_.model.size(), 0);
    for (const Target& t : case_.model.targets())
      if (t.channel == 0)
        for (std::size_t k = t.first; k < t.first + t.count; ++k) r[k] = of_record[t.record];
    return r;
  }

  static constexpr double kWeight = 0.5;
  LinearCase case_{{2e-5, 4e-5, 6e-5, 5e-5}, 1, 0};
};

// Of an offset r in n rows a zero of c floors per sd takes n c²/(n c² + 1/weight), record by
// record.
TEST_F(NuisanceChoiceTest, EliminationIsTheRidgeSolutionOfEachRecord) {
  Nuisances n;
  EXPECT_FALSE(n.any());
  n.Use(case_.model, {Zero(0)}, kWeight);
  EXPECT_TRUE(n.any());
  std::vector<double> r = Offsets({3, -5, 0, 12});
  const std::vector<double> before = r;
  n.Eliminate(r.data());
  const double square = LinearCase::kRows * 100.0, left = 1 - square / (square + 1 / kWeight);
  for (std::size_t k = 0; k < r.size(); ++k) EXPECT_NEAR(r[k], left * before[k], 1e-12);
  const auto amounts = n.Amounts(case_.model, before);
  ASSERT_EQ(amounts.size(), 4u);
  EXPECT_EQ(amounts[3].record, "at 5e-05 m");
  EXPECT_EQ(amounts[3].name, "zero of A.x");
  EXPECT_NEAR(amounts[3].value, (1 - left) * 12e-6, 1e-15);
  EXPECT_NEAR(amounts[3].sd, 10e-6 / std::sqrt(kWeight * square + 1), 1e-12);
}

TEST_F(NuisanceChoiceTest, ColumnsOfAFitLoseTheSameAsTheResidual) {
  Nuisances n;
  n.Use(case_.model, {Zero(0), Zero(1)}, kWeight);
  const std::vector<double> r = Offsets({1, 2, 3, 4});
  Eigen::MatrixXd columns(static_cast<Index>(r.size()), 2);
  columns.col(0) = Eigen::Map<const Eigen::VectorXd>(r.data(), static_cast<Index>(r.size()));
  columns.col(1) = -3 * columns.col(0);
  std::vector<double> same = r;
  n.Eliminate(same.data());
  n.Eliminate(columns);
  for (std::size_t k = 0; k < r.size(); ++k) {
    EXPECT_DOUBLE_EQ(columns(static_cast<Index>(k), 0), same[k]);
    EXPECT_NEAR(columns(static_cast<Index>(k), 1), -3 * same[k], 1e-12);
  }
}

TEST_F(NuisanceChoiceTest, WhatARecordDoesNotFeelIsLeftOut) {
  Nuisances n;
  n.Use(case_.model, {Zero(0, 1e-4)}, kWeight);
  EXPECT_FALSE(n.any());
}

TEST_F(NuisanceChoiceTest, ZerosThatDifferFromRecordToRecordAreChosen) {
  const auto chosen =
      ChooseNuisances(case_.model, {Zero(1), Zero(0)}, Offsets({6, -6, 5, -4}), kWeight);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].name, "zero of A.x");
}

// By hand: two records of information 3, one of 1; mean 1, q = 3 * 1 + 3 * 1 + 1 * 0. Variance
// (6 - 2)/(7 - 19/7) = 14/15, weights 1/(1/3 + 14/15) and 1/(1 + 14/15).
TEST(SpreadOf, IsThatOfDerSimonianAndLaird) {
  const double w = 1 / (1 / 3.0 + 14 / 15.0), v = 1 / (1 + 14 / 15.0);
  const double square = w * (0 + 4) + v * 1, mean = (w * 2 + v) / (2 * w + v);
  EXPECT_NEAR(SpreadOf({0, 2, 1}, {3, 3, 1}, 6), 1 - (2 * w + v) * mean * mean / square, 1e-12);
  EXPECT_EQ(SpreadOf({2, 2}, {1, 5}, 0), 0);
}

// The same offset in every record is an effect of the rig, not a nuisance.
TEST_F(NuisanceChoiceTest, WhatIsTheSameInEveryRecordIsLeftToTheSearch) {
  EXPECT_TRUE(ChooseNuisances(case_.model, {Zero(0)}, Offsets({6, 6, 6, 6}), kWeight).empty());
}

// An effect that acts more in one record than in another has one sign in all.
TEST_F(NuisanceChoiceTest, AmountsOfOneSignAreLeftToTheSearch) {
  for (const double size : {1.0, 0.5})
    EXPECT_TRUE(ChooseNuisances(case_.model, {Zero(0)},
                                Offsets({9 * size, 7 * size, 14 * size, 12 * size}), kWeight)
                    .empty())
        << size;
}

// Beside the effects that were found nothing else is left to explain them.
TEST_F(NuisanceChoiceTest, BesideEffectsAmountsOfOneSignThatExplainMostAreChosen) {
  std::vector<double> left = Offsets({9, 7, 14, 12});
  EXPECT_EQ(ChooseNuisances(case_.model, {Zero(0)}, left, kWeight, true).size(), 1u);
  EXPECT_TRUE(
      ChooseNuisances(case_.model, {Zero(0)}, Offsets({6, 6, 6, 6}), kWeight, true).empty());
  for (const Target& t : case_.model.targets())  // a small part of the error
    if (t.channel == 1)
      for (std::size_t k = t.first; k < t.first + t.count; ++k) left[k] = k % 2 == 0 ? 40 : -40;
  EXPECT_TRUE(ChooseNuisances(case_.model, {Zero(0)}, left, kWeight, true).empty());
}

// What moved the zeros of most sensors moves the others', too: these need to differ, but may have a
// mean of their own.
TEST_F(NuisanceChoiceTest, OfAGroupThatDiffersTheOthersFollow) {
  std::vector<double> left = Offsets({6, -6, 5, -4});  // in A.x
  const std::vector<double> of_y = {9, 7, 14, 12};
  for (const Target& t : case_.model.targets())
    if (t.channel == 1)
      for (std::size_t k = t.first; k < t.first + t.count; ++k) left[k] = of_y[t.record];
  NuisanceKind third = Zero(0);
  third.name = "zero of B.x";
  third.column = StretchColumn(third.column.rows());
  const auto names = [&](const std::vector<NuisanceKind>& possible) {
    std::vector<std::string> out;
    for (const NuisanceKind& k : ChooseNuisances(case_.model, possible, left, kWeight))
      out.push_back(k.name);
    return out;
  };
  NuisanceKind second = Zero(0);  // another direction in the same channel
  second.name = "zero of B.y";
  Eigen::VectorXd turning = Eigen::VectorXd::Zero(second.column.rows());
  for (const Target& t : case_.model.targets())
    if (t.channel == 0)
      for (std::size_t k = t.first; k < t.first + t.count; ++k) {
        turning(static_cast<Index>(k)) = k % 2 == 0 ? 10 : -10;
        left[k] += (k % 2 == 0 ? 5.0 : -5.0) * (t.record % 2 == 0 ? 1 : -1);
      }
  second.column = StretchColumn(turning);
  EXPECT_THAT(names({Zero(1), Zero(0), second}),
              ::testing::UnorderedElementsAre("zero of A.x", "zero of A.y", "zero of B.y"));
  // one of three is not most of them
  EXPECT_THAT(names({Zero(1), Zero(0), third}), ::testing::ElementsAre("zero of A.x"));
}

// What differs much is chosen although its mean is not nothing: an effect beside it may resemble it
// in every record.
TEST_F(NuisanceChoiceTest, AmountsThatDifferMuchAboutAMeanAreChosen) {
  EXPECT_EQ(ChooseNuisances(case_.model, {Zero(0)}, Offsets({14, 6, 12, -1}), kWeight).size(), 1u);
}

// One record that feels the kind far more than the others does not speak for them.
TEST_F(NuisanceChoiceTest, APreciseRecordDoesNotDecideAlone) {
  NuisanceKind k = Zero(0);
  Eigen::VectorXd column = k.column.Segment(0, k.column.rows());
  for (const Target& t : case_.model.targets())
    if (t.channel == 0 && t.record == 0)
      column.segment(static_cast<Index>(t.first), static_cast<Index>(t.count)) *= 30;
  k.column = StretchColumn(column);
  // amounts of 0.2, -0.5, 0.6 and -0.4 sd; nearly all information stands in the first
  EXPECT_EQ(ChooseNuisances(case_.model, {k}, Offsets({60, -5, 6, -4}), kWeight).size(), 1u);
}

// There are many columns that only a logger sees: one has to explain a part of what is left.
TEST_F(NuisanceChoiceTest, ALoggersZeroIsTakenOnlyForAPartOfTheError) {
  NuisanceKind logged = Zero(0);
  logged.group = NuisanceGroup::kLoggerZero;
  std::vector<double> left = Offsets({1.5, -1.5, 1.2, -1.4});
  EXPECT_EQ(ChooseNuisances(case_.model, {logged}, left, kWeight).size(), 1u);
  for (const Target& t : case_.model.targets())  // beside an error that is larger by far
    if (t.channel == 1)
      for (std::size_t k = t.first; k < t.first + t.count; ++k) left[k] = k % 2 == 0 ? 40 : -40;
  EXPECT_TRUE(ChooseNuisances(case_.model, {logged}, left, kWeight).empty());
}

TEST_F(NuisanceChoiceTest, ASmallGainIsNotWorthItsPrice) {
  EXPECT_TRUE(
      ChooseNuisances(case_.model, {Zero(0)}, Offsets({0.5, -0.5, 0.5, -0.5}), kWeight).empty());
}

}  // namespace
}  // namespace ambrig
