// The two models of a search: noise, floors and rows that both share.
#include "discovery/explain/search_models.h"

#include <gtest/gtest.h>

#include "tests/discovery/explain/search_parts.h"

namespace ambrig {
namespace {

class SearchModelsTest : public testing::SearchParts {};

TEST_F(SearchModelsTest, BothModelsHaveTheNoiseAndItsFloors) {
  EXPECT_NEAR(models_.noise().Used("A.x"), 2e-7, 0.3e-7);
  ASSERT_EQ(models_.full().targets().size(), models_.thinned().targets().size());
  for (std::size_t t = 0; t < models_.full().targets().size(); ++t)
    EXPECT_EQ(models_.full().targets()[t].floor, models_.thinned().targets()[t].floor);
  EXPECT_NEAR(models_.At(nominal_).ratio_fit, 1, 0.1);
  EXPECT_TRUE(models_.InspectData(nominal_, noise_).empty());
  EXPECT_GT(models_.runs(), 0);
}

TEST_F(SearchModelsTest, RowsLeftOutOfOneFitCountAgainBehindIt) {
  const double before = CountedRows(models_.thinned(), models_.thinned().targets()[0]);
  models_.FitWithoutRows({{0, 100, 199}}, nominal_);
  EXPECT_EQ(CountedRows(models_.thinned(), models_.thinned().targets()[0]), before);
  models_.LeaveOut({{0, 100, 199}});
  EXPECT_EQ(CountedRows(models_.thinned(), models_.thinned().targets()[0]), before - 100);
  EXPECT_EQ(CountedRows(models_.full(), models_.full().targets()[0]), before - 100);
}

TEST_F(SearchModelsTest, FloorsAreRaisedAndSetBackTogether) {
  const SearchModels::Floors before = models_.floors();
  ASSERT_TRUE(models_.RaiseFloors(nominal_));
  for (std::size_t t = 0; t < before.targets.size(); ++t)
    EXPECT_GE(models_.thinned().targets()[t].floor, before.targets[t].floor);
  models_.SetFloors(before);
  for (std::size_t t = 0; t < before.targets.size(); ++t)
    EXPECT_EQ(models_.thinned().targets()[t].floor, before.targets[t].floor);
  EXPECT_EQ(models_.effective_sample_size(), before.effective_sample_size);
}

}  // namespace
}  // namespace ambrig
