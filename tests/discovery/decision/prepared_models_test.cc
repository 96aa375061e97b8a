// The model of fewer rows that fits look at leaves out what the model of all rows leaves out.
#include "discovery/decision/prepared_models.h"

#include <gtest/gtest.h>

#include "discovery/practice/practice_surroundings.h"
#include "tests/discovery/clamped_reference.h"

namespace ambrig {
namespace {

class PreparedModels : public testing::ClampedReference {};

TEST_F(PreparedModels, LeaveOutTheSameRows) {
  Hypothesis drawing = Hypothesis::Base(rig_);
  Case data = EmptyCase(rig_, records_);
  FillRecords(Surroundings(), drawing, 5, nullptr, data);
  CaseModel full(data), thin(data, 3);
  const Comparison before = PrepareModels(full, thin, drawing);
  ASSERT_FALSE(before.unpredictable.empty());  // currents that end near a switching edge
  std::size_t left_out = 0;
  for (std::size_t t = 0; t < thin.targets().size(); ++t)
    for (std::size_t k = 0; k < thin.targets()[t].count; ++k) {
      const std::size_t row = thin.targets()[t].first + k;
      ASSERT_EQ(thin.ok()[row], full.ok()[full.targets()[t].first + thin.sample(row)]);
      left_out += thin.ok()[row] ? 0 : 1;
    }
  EXPECT_GT(left_out, 0u);
}

}  // namespace
}  // namespace ambrig
