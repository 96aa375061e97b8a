// Zeros of records that are written down: taken off where they explain the error.
#include "discovery/explain/nuisance_selection.h"

#include <gtest/gtest.h>

#include <vector>

#include "effects/catalogue.h"
#include "tests/discovery/data_gate/gate_case.h"
#include "tests/discovery/explain/search_parts.h"

namespace ambrig {
namespace {

const std::vector<double> kZeroOfRecord = {4e-6, -3e-6, 2e-6, -4e-6};  // [m], of A.x

class ZerosOfRecords : public testing::SearchParts {
 protected:
  ZerosOfRecords() : SearchParts(testing::FourPlaces(1, kZeroOfRecord)) {}
};

class NoZerosOfRecords : public testing::SearchParts {};

TEST_F(ZerosOfRecords, AreTakenOffWhereTheyExplainTheError) {
  const FitResult bare = models_.FitFrom(nominal_);
  ASSERT_GT(bare.ratio_fit, 3);
  FitResult now = bare;
  const auto before = nuisances_.Try(now, 0.5, false);
  ASSERT_TRUE(before.has_value());
  EXPECT_LT(now.ratio_fit, 1.2);
  EXPECT_EQ(before->fit.ratio_fit, bare.ratio_fit);
  ASSERT_EQ(log_.ladder.size(), 1u);
  EXPECT_TRUE(models_.full().nuisances.differ());
  for (const NuisanceFound& f : AmountsOfNuisances(models_.thinned(), now.predicted))
    for (std::size_t r = 0; r < case_.records.size(); ++r) {
      if (f.name != "zero of A.x" || f.record != case_.records[r].data_file) continue;
      EXPECT_NEAR(f.value, kZeroOfRecord[r], 0.5e-6);
    }
  // the same errors as before once they are put aside
  nuisances_.UseAgain(before->used);
  EXPECT_FALSE(models_.full().nuisances.any());
  EXPECT_NEAR(models_.At(bare.hypothesis).ratio_fit, bare.ratio_fit, 1e-9);
}

TEST_F(NoZerosOfRecords, AreNotTried) {
  FitResult now = models_.FitFrom(nominal_);
  EXPECT_FALSE(nuisances_.Try(now, 0.5, false).has_value());
  EXPECT_FALSE(models_.full().nuisances.any());
  EXPECT_TRUE(log_.ladder.empty());
}

/// Three records of a free rotor and one of a held one, with a load at A that the model lacks.
Case UnderALoad() {
  EffectInstance load = MakeInstance(EffectNamed("constant-load"), "A");
  load.Set("fx", 6);
  load.Set("fy", -4);
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(testing::RadialRig(), 4))
    if (r.title == "multisine at rest" || r.title == "multisine at 60 Hz" ||
        r.title == testing::kStepRecord || r.title == testing::kClampedRecord)
      chosen.push_back(r);
  Hypothesis truth;
  truth.rig = testing::RadialRig();
  truth.rig.effects = {load};
  return testing::MeasuredBy(truth, EmptyCase(testing::RadialRig(), chosen));
}

class LoadedRecords : public testing::SearchParts {
 protected:
  LoadedRecords() : SearchParts(UnderALoad()) {}
};

// The load moves the currents of every free rotor as one zero of a sensor would, which the held
// rotor does not show.
TEST_F(LoadedRecords, WhatIsTheSameInAllOfAKindIsLeftToEffects) {
  FitResult now = models_.FitFrom(nominal_);
  ASSERT_GT(now.ratio_fit, 1.5);
  EXPECT_FALSE(nuisances_.Try(now, 0.5, false).has_value());
  EXPECT_FALSE(models_.full().nuisances.any());
}

}  // namespace
}  // namespace ambrig
