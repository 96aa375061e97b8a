// Which errors of the coils are taken for such, of columns that are written down.
#include "discovery/decision/coil_choice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using Eigen::Index;

constexpr Index kErrors = 8, kRowsEach = 12;  // of A.x and A.y of the first record

class CoilChoice : public ::testing::Test {
 protected:
  CoilChoice() : case_({1e-5, 2e-5}, 1, 0) {
    for (Index k = 0; k < kErrors; ++k) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(Rows());
      column.segment(k * kRowsEach, kRowsEach).setConstant(3);
      possible_.push_back({fmt::format("error {}", k), NuisanceGroup::kCurrentGain, "-", 0.005,
                           StretchColumn(column), true, fmt::format("A.coil{}", k + 1)});
    }
  }
  Index Rows() const { return static_cast<Index>(case_.model.size()); }
  /// A fit without free parameters that leaves these amounts of the errors.
  FitResult Leaving(const std::vector<double>& amounts) const {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(Rows());
    for (Index k = 0; k < kErrors; ++k)
      r.segment(k * kRowsEach, kRowsEach).setConstant(3 * amounts[static_cast<std::size_t>(k)]);
    FitResult fit;
    fit.residual.assign(r.data(), r.data() + r.size());
    fit.jacobian = Eigen::MatrixXd(Rows(), 0);
    return fit;
  }
  CoilErrorChoice Choose(const FitResult& fit) const {
    return ChooseCoilErrors(case_.model, possible_, fit, static_cast<double>(Rows()));
  }
  LinearCase case_;
  std::vector<NuisanceKind> possible_;
};

TEST_F(CoilChoice, AmountsOfTheStatedSpreadAreTakenAsBesideNoise) {
  const CoilErrorChoice choice = Choose(Leaving({1, -1, 0.5, 2, -1.5, 0.2, -0.7, 1.1}));
  EXPECT_EQ(choice.kinds.size(), 8u);
  EXPECT_EQ(choice.doubt, 1);
}

TEST_F(CoilChoice, OneCoilFarBeyondTheSpreadIsLeftToBeNamed) {
  const CoilErrorChoice choice = Choose(Leaving({1, -1, 0.5, 6, -1.5, 0.2, -0.7, 1.1}));
  ASSERT_EQ(choice.kinds.size(), 7u);
  for (const NuisanceKind& kind : choice.kinds) EXPECT_NE(kind.coil, "A.coil4");
  EXPECT_TRUE((choice.kinds[0].column.Segment(0, Rows()) - possible_[0].column.Segment(0, Rows()))
                  .isZero(0));
  EXPECT_EQ(choice.doubt, 1);
}

// Eight errors of 2 sd each are believable, but not all of one sign: what they have in common is
// left.
TEST_F(CoilChoice, WhatAllCoilsOfABearingShareIsLeftToBeNamed) {
  const CoilErrorChoice apart = Choose(Leaving({2, -2, 2, 2, -2, -2, 2, -2}));
  const CoilErrorChoice together = Choose(Leaving({2, 2.5, 2, 1.5, 2, 2, 1.5, 2.5}));
  ASSERT_EQ(together.kinds.size(), 8u);
  EXPECT_EQ(together.doubt, 1);
  const Eigen::VectorXd column = possible_[2].column.Segment(0, Rows());
  EXPECT_TRUE((apart.kinds[2].column.Segment(0, Rows()) - column).isZero(0));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(Rows());
  for (const NuisanceKind& kind : together.kinds) sum += kind.column.Segment(0, Rows());
  EXPECT_LT(sum.norm(), 1e-12 * column.norm());
  EXPECT_NEAR(together.kinds[2].column.Segment(0, Rows()).norm(),
              std::sqrt(7.0 / 8) * column.norm(), 1e-12 * column.norm());
}

// All coils far off together are no errors of single coils: they are weighed so little that they
// take hardly any of it.
TEST_F(CoilChoice, WhatLooksLikeAllCoilsFarOffIsNotBelieved) {
  const CoilErrorChoice choice = Choose(Leaving({6, -6, 6, 6, -6, 6, 6, -6}));
  EXPECT_GT(choice.doubt, 2);
}

// What the coils can do alone, but with a parameter of the rig far beyond its tolerance, is not
// believed.
TEST_F(CoilChoice, AParameterFarBeyondItsToleranceIsNotBelieved) {
  FitResult fit = Leaving({1, -1, 0.5, 2, -1.5, 0.2, -0.7, 1.1});
  FreeParameter gap;
  gap.path = "bearings.A.gap";
  gap.sd = gap.step = 1;
  fit.hypothesis.free = {gap};
  fit.jacobian = Eigen::MatrixXd::Zero(Rows(), 1);
  for (Index row = kErrors * kRowsEach; row < Rows(); ++row) {
    fit.residual[static_cast<std::size_t>(row)] = 6;
    fit.jacobian(row, 0) = 6;  // one sd
  }
  EXPECT_EQ(Choose(fit).doubt, 1);
  fit.jacobian /= 12;
  EXPECT_GT(Choose(fit).doubt, 2);
}

// A free parameter of the rig that does the same has it where its tolerance allows it more easily.
TEST_F(CoilChoice, ParametersOfTheRigStandBesideThem) {
  FitResult fit = Leaving({3, -3, 3, 3, -3, -3, 3, -3});
  EXPECT_GT(Choose(fit).doubt, 1);
  FreeParameter gap;
  gap.path = "bearings.A.gap";
  gap.sd = gap.step = 1;
  fit.hypothesis.free = {gap};
  fit.jacobian = Eigen::Map<const Eigen::VectorXd>(fit.residual.data(), Rows());
  EXPECT_EQ(Choose(fit).doubt, 1);
  // What a parameter of no prior to speak of can do too is known of the coils together as well as
  // their prior says, of a single one beside the others as well as its rows do.
  const auto sds = [&](const FitResult& now) {
    return SdOfCoilErrors(case_.model, possible_, now, static_cast<double>(Rows()), 1);
  };
  const double weight = 1, rows = 9.0 * kRowsEach, alone = 1 / std::sqrt(weight * rows + 1);
  EXPECT_NEAR(sds(Leaving(std::vector<double>(8, 0)))[2], 0.005 * alone, 1e-9);
  const double beside = sds(fit)[2] / 0.005;
  EXPECT_GT(beside, 3 * alone);
  EXPECT_LT(beside, 0.4);  // an eighth of the shared part
}

}  // namespace
}  // namespace ambrig
