// The two models of a case whose measurements are written down: noise of 2e-7 m at known places.
#include "discovery/explain/search_models.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "discovery/explain/effect_removal.h"
#include "discovery/explain/nuisance_selection.h"
#include "discovery/explain/search_progress.h"
#include "tests/discovery/linear_case.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

constexpr double kZeroOfRecord[] = {4e-6, -3e-6, 2e-6, -4e-6};  // [m]

class SearchParts : public ::testing::Test {
 protected:
  /// Zeros [floors of 2e-7 m] of A.x that differ from record to record, times `size`.
  explicit SearchParts(double size = 0)
      : case_(MeasuredCase({{2e-5, 3e-5, 1, size * kZeroOfRecord[0]},
                            {-6e-5, 1e-5, 1, size * kZeroOfRecord[1]},
                            {5e-5, -4e-5, 1, size * kZeroOfRecord[2]},
                            {-3e-5, -5e-5, 1, size * kZeroOfRecord[3]}})),
        nominal_(Hypothesis::Base(case_.rig)),
        models_(case_, nullptr, nullptr),
        progress_(options_, models_) {
    models_.LimitToHeld(nominal_);
    noise_ = models_.FindNoise(nominal_);
    models_.UseFloors(nominal_);
  }

  const Case case_;
  const Hypothesis nominal_;
  ExplainOptions options_;
  SearchModels models_;
  SearchProgress progress_;
  SearchModels::FoundNoise noise_;
  SearchLog log_;
};

TEST_F(SearchParts, BothModelsHaveTheNoiseAndItsFloors) {
  EXPECT_NEAR(models_.noise().Used("A.x"), 2e-7, 0.3e-7);
  ASSERT_EQ(models_.full().targets().size(), models_.thinned().targets().size());
  for (std::size_t t = 0; t < models_.full().targets().size(); ++t)
    EXPECT_EQ(models_.full().targets()[t].floor, models_.thinned().targets()[t].floor);
  EXPECT_NEAR(models_.At(nominal_).ratio_fit, 1, 0.1);
  EXPECT_TRUE(models_.InspectData(nominal_, noise_).empty());
  EXPECT_GT(models_.runs(), 0);
}

TEST_F(SearchParts, RowsLeftOutOfOneFitCountAgainBehindIt) {
  const double before = CountedRows(models_.thinned(), models_.thinned().targets()[0]);
  models_.FitWithoutRows({{0, 100, 199}}, nominal_);
  EXPECT_EQ(CountedRows(models_.thinned(), models_.thinned().targets()[0]), before);
  models_.LeaveOut({{0, 100, 199}});
  EXPECT_EQ(CountedRows(models_.thinned(), models_.thinned().targets()[0]), before - 100);
  EXPECT_EQ(CountedRows(models_.full(), models_.full().targets()[0]), before - 100);
}

TEST_F(SearchParts, FloorsAreRaisedAndSetBackTogether) {
  const SearchModels::Floors before = models_.floors();
  ASSERT_TRUE(models_.RaiseFloors(nominal_));
  for (std::size_t t = 0; t < before.targets.size(); ++t)
    EXPECT_GE(models_.thinned().targets()[t].floor, before.targets[t].floor);
  models_.SetFloors(before);
  for (std::size_t t = 0; t < before.targets.size(); ++t)
    EXPECT_EQ(models_.thinned().targets()[t].floor, before.targets[t].floor);
  EXPECT_EQ(models_.effective_sample_size(), before.effective_sample_size);
}

TEST_F(SearchParts, ProgressOfAPartIsAPartOfTheWhole) {
  std::vector<double> fractions;
  options_.progress = [&](double f, const std::string&) { fractions.push_back(f); };
  progress_(0.25, "first");
  const auto part = progress_.Part(0.5, 0.2);
  part(0, "part");
  part(1, "part");
  ASSERT_EQ(fractions.size(), 3u);
  EXPECT_DOUBLE_EQ(fractions[1], 0.5);
  EXPECT_DOUBLE_EQ(fractions[2], 0.7);
  std::atomic<bool> stop = true;
  options_.stop = &stop;
  EXPECT_THROW(progress_(0.8, "next"), Interrupted);
}

TEST_F(SearchParts, AnEffectWithoutASizeIsRemovedWithAWarning) {
  NuisanceSelection nuisances(models_, log_, progress_);
  CoilErrorSelection coils(models_, nuisances, log_, progress_);
  AdoptedEffects adopted(0);
  NameRankings names;
  EffectRemoval removal(models_, coils, adopted, names, log_, progress_);
  const FitResult base = models_.FitFrom(nominal_);
  Hypothesis h = base.hypothesis;
  h.AddEffect(LinearCase::Offset(1e-8));
  FitResult now = models_.FitFrom(h);
  adopted.AddLastOf(now);
  removal.DropSizeless(base, now);
  EXPECT_TRUE(adopted.empty());
  EXPECT_EQ(now.ratio_fit, base.ratio_fit);
  ASSERT_EQ(log_.warnings.size(), 1u);
  EXPECT_EQ(log_.warnings[0], "sensor-offset at A.x lies within 3 sd of nothing: it is not named");
}

class ZerosOfRecords : public SearchParts {
 protected:
  ZerosOfRecords() : SearchParts(1) {}
};

TEST_F(ZerosOfRecords, AreTakenOffWhereTheyExplainTheError) {
  NuisanceSelection nuisances(models_, log_, progress_);
  const FitResult bare = models_.FitFrom(nominal_);
  ASSERT_GT(bare.ratio_fit, 3);
  FitResult now = bare;
  const auto before = nuisances.Try(now, 0.5, false);
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
  nuisances.UseAgain(before->used);
  EXPECT_FALSE(models_.full().nuisances.any());
  EXPECT_NEAR(models_.At(bare.hypothesis).ratio_fit, bare.ratio_fit, 1e-9);
}

TEST_F(SearchParts, NuisancesThatExplainNothingAreNotTried) {
  NuisanceSelection nuisances(models_, log_, progress_);
  FitResult now = models_.FitFrom(nominal_);
  EXPECT_FALSE(nuisances.Try(now, 0.5, false).has_value());
  EXPECT_FALSE(models_.full().nuisances.any());
  EXPECT_TRUE(log_.ladder.empty());
}

}  // namespace
}  // namespace ambrig
