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

/// Records of so many rows, one channel each.
Case OfRows(const std::vector<std::size_t>& rows) {
  Case c;
  for (const std::size_t n : rows) {
    CaseRecord r;
    r.data.channels = {{"A.x", "m", std::vector<double>(n)}};
    c.records.push_back(std::move(r));
  }
  return c;
}

TEST(ThinningTo, IsTheSameForRecordsOfLikeLengths) {
  using Thinning = std::vector<std::size_t>;
  EXPECT_EQ(ThinningTo(OfRows({500, 300, 400}), 2000), (Thinning{1, 1, 1}));
  EXPECT_EQ(ThinningTo(OfRows({5000, 3000, 4000}), 2000), (Thinning{6, 6, 6}));
  EXPECT_EQ(ThinningTo(OfRows({50000, 30000, 40000}), 2000), (Thinning{12, 12, 12}));
}

// A pulse of 0.3 s beside hovers of a minute: it keeps a quarter of a record's mean share, or all
// that it has.
TEST(ThinningTo, AShortRecordIsNotLostBesideLongOnes) {
  const std::vector<std::size_t> thin = ThinningTo(OfRows({60000, 60000, 300, 3000}), 2000);
  EXPECT_EQ(thin[0], 61U);
  EXPECT_EQ(thin[1], 61U);
  EXPECT_EQ(thin[2], 2U);
  EXPECT_NEAR(3000.0 / static_cast<double>(thin[3]), 125, 10);
}

// Of rows that are alike a third are worth more each.
TEST_F(PreparedModels, FewerRowsAreWorthMoreEach) {
  Hypothesis drawing = Hypothesis::Base(rig_);
  Case data = EmptyCase(rig_, records_);
  FillRecords(Surroundings(), drawing, 5, nullptr, data);
  CaseModel full(data), thin(data, 3);
  for (Target& t : full.targets()) t.independent = t.record == 0 ? 0.1 : 0.9;
  PassFloorsOn(full, thin);
  for (const Target& t : thin.targets()) EXPECT_NEAR(t.independent, t.record == 0 ? 0.3 : 1, 0.01);
}

}  // namespace
}  // namespace ambrig
