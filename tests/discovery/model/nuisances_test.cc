// What may differ from record to record is taken off every residual: amounts and what is left in
// closed form, for columns that are written down.
#include "discovery/model/nuisances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/model/nuisance_kinds.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using Eigen::Index;

/// Rows of A.x of one record, or of all (-1), at `height`; nothing elsewhere.
Eigen::VectorXd RowsOfAx(const CaseModel& model, int record, double height) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(static_cast<Index>(model.size()));
  for (const Target& t : model.targets())
    if (t.channel == 0 && (record < 0 || t.record == static_cast<std::size_t>(record)))
      column.segment(static_cast<Index>(t.first), static_cast<Index>(t.count)).setConstant(height);
  return column;
}

std::vector<double> NumbersOf(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

class NuisanceTest : public ::testing::Test {
 protected:
  NuisanceTest() : linear_({1e-5, 2e-5, 3e-5}, 1, 0) {}
  const CaseModel& model() const { return linear_.model; }
  /// A zero of A.x with an sd of 2 µm, two floors of 1 µm.
  NuisanceKind Zero() const {
    return {"zero of A.x", NuisanceGroup::kSensorZero, "m", 2e-6,
            StretchColumn(RowsOfAx(model(), -1, 2))};
  }
  /// The same zero in all records, their amounts weighed by `w`.
  Nuisances OneZeroOfAll(double w) const {
    NuisanceKind zero = Zero();
    zero.in_all_records = true;
    Nuisances nuisances;
    nuisances.Use(model(), {zero}, 1, w);
    return nuisances;
  }
  LinearCase linear_;
};

// Offset d over n rows, columns c = sd/floor: amount = n c d / (n c² + 1/w) of one sd.
TEST_F(NuisanceTest, AmountsAreThoseOfTheRidgeFitRecordByRecord) {
  const double w = 0.25, n = LinearCase::kRows;
  Nuisances nuisances;
  nuisances.Use(model(), {Zero()}, w);
  EXPECT_TRUE(nuisances.any());
  const Eigen::VectorXd residual = RowsOfAx(model(), 0, 3) - RowsOfAx(model(), 2, 1.5);
  const auto found = nuisances.Amounts(model(), NumbersOf(residual));
  ASSERT_EQ(found.size(), 3u);
  const double share = n * 2 / (n * 4 + 1 / w);
  EXPECT_NEAR(found[0].value, 3 * share * 2e-6, 1e-15);
  EXPECT_NEAR(found[1].value, 0, 1e-15);
  EXPECT_NEAR(found[2].value, -1.5 * share * 2e-6, 1e-15);
  for (const NuisanceFound& f : found) {
    EXPECT_EQ(f.name, "zero of A.x");
    EXPECT_EQ(f.unit, "m");
    EXPECT_NEAR(f.sd, 2e-6 / std::sqrt(w * n * 4 + 1), 1e-15);
  }
  EXPECT_EQ(found[2].record, linear_.data.records[2].data_file);
}

// The floor of A.x rises to 4 µm: an sd of 2 µm is half of it, and an offset of 3 µm the same
// amount as before where the prior holds nothing back.
TEST_F(NuisanceTest, AmountsStayTheSameOverNewFloors) {
  const double w = 1e6;
  const std::vector<NuisanceKind> kinds = {Zero()};
  const std::vector<Target> before = model().targets();
  Nuisances nuisances;
  nuisances.Use(model(), kinds, w);
  const auto found = nuisances.Amounts(model(), NumbersOf(RowsOfAx(model(), 0, 3)));
  double of_first = 0;
  for (Target& t : linear_.model.targets())
    if (t.channel == 0) {
      of_first = t.floor;
      t.floor *= 4;
    }
  ASSERT_GT(of_first, 0);
  const std::vector<NuisanceKind> renewed = OverNewFloors(kinds, model(), before);
  EXPECT_NEAR(renewed[0].column.Segment(0, 1)(0), 0.5, 1e-12);
  nuisances.Use(model(), renewed, w);
  const auto again = nuisances.Amounts(model(), NumbersOf(RowsOfAx(model(), 0, 3.0 / 4)));
  ASSERT_EQ(found.size(), again.size());
  EXPECT_NEAR(again[0].value, found[0].value, 1e-6 * found[0].value);
}

// What is left of an offset is its share that the prior holds back; other channels stay as they
// were.
TEST_F(NuisanceTest, EliminationLeavesWhatThePriorHoldsBack) {
  const double w = 1, n = LinearCase::kRows;
  Nuisances nuisances;
  nuisances.Use(model(), {Zero()}, w);
  Eigen::VectorXd residual = RowsOfAx(model(), 1, 3);
  for (const Target& t : model().targets())
    if (t.channel == 1) residual.segment(static_cast<Index>(t.first), 4) << 1, -1, 1, -1;
  const Eigen::VectorXd before = residual;
  nuisances.Eliminate(residual.data());
  const double left = 3 * (1 / w) / (n * 4 + 1 / w);
  for (const Target& t : model().targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      const auto i = static_cast<Index>(k);
      const double expected = t.channel == 1 ? before(i) : t.record == 1 ? left : 0;
      EXPECT_NEAR(residual(i), expected, 1e-12) << k;
    }
}

// Residuals and sensitivities are treated alike, so that a fit sees one linear problem.
TEST_F(NuisanceTest, EliminationIsLinear) {
  Nuisances nuisances;
  nuisances.Use(model(), {Zero()}, 0.5);
  const Index rows = static_cast<Index>(model().size());
  Eigen::MatrixXd columns(rows, 2);
  for (Index k = 0; k < rows; ++k)
    columns.row(k) << std::sin(0.1 * static_cast<double>(k)), static_cast<double>(k % 7);
  Eigen::VectorXd sum = 2 * columns.col(0) - 3 * columns.col(1);
  const Eigen::VectorXd zero = RowsOfAx(model(), 0, 2);
  const double along = columns.col(0).dot(zero), n = LinearCase::kRows;
  nuisances.Eliminate(columns);
  nuisances.Eliminate(sum.data());
  EXPECT_LT((sum - 2 * columns.col(0) + 3 * columns.col(1)).norm(), 1e-10);
  // what the nuisance explains is gone: nothing of its column is left but the prior's share
  EXPECT_NEAR(columns.col(0).dot(zero), along * 2 / (4 * n + 2), 1e-10);
}

TEST_F(NuisanceTest, ARecordThatDoesNotFeelAKindHasNoAmountOfIt) {
  NuisanceKind first_only = Zero();
  first_only.column = StretchColumn(RowsOfAx(model(), 0, 2));
  NuisanceKind feeble{"drift of A.x", NuisanceGroup::kDrift, "m", 1e-12,
                      StretchColumn(RowsOfAx(model(), -1, 1e-6))};
  Nuisances nuisances;
  nuisances.Use(model(), {first_only, feeble}, 1);
  const auto found = nuisances.Amounts(model(), std::vector<double>(model().size(), 1));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].record, linear_.data.records[0].data_file);
  nuisances.Use(model(), {feeble}, 1);
  EXPECT_FALSE(nuisances.any());
  nuisances.Use(model(), {}, 1);
  EXPECT_FALSE(nuisances.any());
}

// Two kinds that do the same share what there is; the data do not say whose it is.
TEST_F(NuisanceTest, TwoKindsOfOneShapeShareTheAmount) {
  NuisanceKind twin = Zero();
  twin.name = "logger zero of A.x";
  Nuisances nuisances;
  nuisances.Use(model(), {Zero(), twin}, 1);
  const auto found = nuisances.Amounts(model(), NumbersOf(RowsOfAx(model(), 0, 4)));
  ASSERT_EQ(found.size(), 6u);
  EXPECT_NEAR(found[0].value, found[1].value, 1e-15);
  EXPECT_NEAR(found[0].value + found[1].value, 4e-6, 0.02e-6);
  EXPECT_GT(found[0].sd, 1e-6);  // of the sum the sd would be 0.1 µm
}

// One amount for all records, of which the last is unseen: from the n rows of each fitted one.
TEST_F(NuisanceTest, AmountsOfAllRecordsAreEstimatedFromTheFittedOnes) {
  const double w = 0.25, n = LinearCase::kRows;
  const Nuisances nuisances = OneZeroOfAll(w);
  EXPECT_TRUE(nuisances.any());
  EXPECT_FALSE(nuisances.differ());
  EXPECT_EQ(nuisances.count(), 0u);
  const Eigen::VectorXd residual = RowsOfAx(model(), 0, 3) + RowsOfAx(model(), 1, 1);
  const auto found = nuisances.Amounts(model(), NumbersOf(residual));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].record, "");
  EXPECT_NEAR(found[0].value, (3 + 1) * 2 * n / (2 * 4 * n + 1 / w) * 2e-6, 1e-15);
  EXPECT_NEAR(found[0].sd, 2e-6 / std::sqrt(w * 2 * 4 * n + 1), 1e-15);
}

// Fitted rows r along the column c keep r'(1 + w c c')⁻¹ r of their square, the price of the
// amount; from the unseen record the estimate is taken off.
TEST_F(NuisanceTest, WhatAllRecordsShareIsWeighedByItsCovariance) {
  const double w = 0.01, n = LinearCase::kRows;
  const Nuisances nuisances = OneZeroOfAll(w);
  Eigen::VectorXd rows = RowsOfAx(model(), -1, 3);
  nuisances.Eliminate(rows.data());
  const double amount = 3 * 2 * 2 * n / (2 * 4 * n + 1 / w);
  for (const Target& t : model().targets()) {
    const double expected = t.channel == 1  ? 0
                            : t.record == 2 ? 3 - 2 * amount
                                            : 3 / std::sqrt(1 + w * 2 * 4 * n);
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      EXPECT_NEAR(rows(static_cast<Index>(k)), expected, 1e-12) << k;
  }
}

TEST_F(NuisanceTest, RecordsThatAreNotKnownTellNothingOfWhatAllShare) {
  const double w = 0.01, n = LinearCase::kRows;
  const Nuisances nuisances = OneZeroOfAll(w);
  const std::vector<char> first_only = {1, 0, 0};
  for (const double of_second : {0.0, 1e6}) {
    Eigen::VectorXd rows = RowsOfAx(model(), 0, 3) + RowsOfAx(model(), 1, of_second);
    Eigen::MatrixXd columns = rows;
    nuisances.Eliminate(rows.data(), &first_only);
    EXPECT_NEAR(rows(0), 3 / std::sqrt(1 + w * 4 * n), 1e-12);
    nuisances.Eliminate(columns, &first_only);
    EXPECT_EQ(columns.col(0), rows);
  }
}

// Zeros of each record and a zero of all: the shared amount is what the records' own ones, held
// back by their prior, do not take.
TEST_F(NuisanceTest, BothKindsOfAmountsStandBesideEachOther) {
  NuisanceKind shared = Zero(), own = Zero();
  shared.name = "zero of all";
  shared.in_all_records = true;
  own.column = StretchColumn(RowsOfAx(model(), -1, 0.02));  // a hundredth of the shared one
  Nuisances nuisances;
  nuisances.Use(model(), {own, shared}, 1);
  EXPECT_TRUE(nuisances.differ());
  const auto found = nuisances.Amounts(model(), NumbersOf(RowsOfAx(model(), -1, 2)));
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].name, "zero of all");
  EXPECT_NEAR(found[0].value, 2e-6, 0.01e-6);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_LT(std::abs(found[k].value), 0.02e-6);
}

// Rows that do not count tell nothing of an amount.
TEST_F(NuisanceTest, RowsThatAreLeftOutDoNotCount) {
  const double n = LinearCase::kRows;
  linear_.model.LeaveOut({{0, 0, LinearCase::kRows / 2 - 1}});
  Nuisances nuisances;
  nuisances.Use(model(), {Zero()}, 1);
  Eigen::VectorXd rows = RowsOfAx(model(), 0, 3);
  for (Index k = 0; k < static_cast<Index>(LinearCase::kRows / 2); ++k) rows(k) = 0;
  const auto found = nuisances.Amounts(model(), NumbersOf(rows));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].value, 3 * 2 * n / 2 / (4 * n / 2 + 1) * 2e-6, 1e-15);
}

// A model with every fifth row sees the same columns at its rows.
TEST_F(NuisanceTest, ThinnedColumnsAreThoseOfTheRowsThatAreLeft) {
  const CaseModel thin(linear_.data, 5);
  NuisanceKind ramp = Zero();
  Eigen::VectorXd rows(static_cast<Index>(model().size()));
  for (Index k = 0; k < rows.size(); ++k) rows(k) = static_cast<double>(k);
  ramp.column = StretchColumn(rows);
  const auto thinned = Thinned({ramp}, model(), thin);
  ASSERT_EQ(thinned.size(), 1u);
  EXPECT_EQ(thinned[0].name, ramp.name);
  EXPECT_EQ(thinned[0].sd, ramp.sd);
  ASSERT_EQ(static_cast<std::size_t>(thinned[0].column.rows()), thin.size());
  ASSERT_LT(thin.size(), model().size());
  for (std::size_t t = 0; t < thin.targets().size(); ++t) {
    const Target &few = thin.targets()[t], &all = model().targets()[t];
    for (std::size_t row = few.first; row < few.first + few.count; ++row)
      EXPECT_EQ(thinned[0].column.Segment(static_cast<Index>(row), 1)(0),
                static_cast<double>(all.first + thin.sample(row)));
  }
  // what is zero stays so
  EXPECT_EQ(Thinned({Zero()}, model(), thin)[0].column.SquaredNorm(0, thinned[0].column.rows()),
            Zero().column.SquaredNorm(0, Zero().column.rows()) / 5);
}

/// Declared in the case file: the sd is the one that stands there, nothing else is added.
TEST_F(NuisanceTest, DeclaredOnesAloneAreTheirs) {
  Case c = linear_.data;
  c.nuisances.sensor_zero = {{"A.x", 5e-6}};
  CaseModel model(c);
  for (Target& t : model.targets()) t.floor = LinearCase::kFloor;
  const Hypothesis h = Hypothesis::Base(c.rig);
  const auto predicted = model.Predict(h);
  ASSERT_TRUE(predicted);
  const auto kinds = NuisanceKindsOf(model, h, *predicted, true);
  ASSERT_FALSE(kinds.empty());
  for (const NuisanceKind& k : kinds) {
    EXPECT_NE(k.name.find("A.x"), std::string::npos) << k.name;
    EXPECT_EQ(k.sd, 5e-6);
    EXPECT_EQ(k.unit, "m");
  }
  EXPECT_TRUE(NuisanceKindsOf(this->model(), h, *predicted, true).empty());
  // none declared: every channel has a usual one, and the clock
  bool clock = false, y = false;
  for (const NuisanceKind& k : NuisanceKindsOf(this->model(), h, *predicted, false)) {
    clock = clock || k.group == NuisanceGroup::kTimeShift;
    y = y || k.name.find("A.y") != std::string::npos;
    EXPECT_GT(k.sd, 0) << k.name;
  }
  EXPECT_TRUE(clock);
  EXPECT_TRUE(y);
}

}  // namespace
}  // namespace ambrig
