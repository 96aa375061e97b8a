// Branches of the heavy compressor's current loops, whose limiters hold while a current rises.
#include "discovery/model/branch_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/noise.h"
#include "discovery/experiment/examination.h"
#include "discovery/model/floor.h"
#include "discovery/model/residual.h"
#include "rig/rig_file.h"
#include "tests/discovery/data_gate/gate_case.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

Case Clamped(const std::string& rig_file) {
  const RigParameters rig = ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + rig_file);
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (r.title.starts_with("clamped, current")) chosen.push_back(r);
  Hypothesis truth;
  truth.rig = rig;
  return testing::MeasuredBy(truth, EmptyCase(rig, chosen));
}

class BranchRowsTest : public ::testing::Test {
 protected:
  BranchRowsTest() { FindFloor(model_, nominal_); }

  /// The tolerances drawn from another stream than the lines that branches are sought on, `part` of
  /// a sd.
  Hypothesis Drawn(std::uint64_t number, double part) const {
    Hypothesis h = nominal_;
    for (std::size_t k = 0; k < h.free.size(); ++k)
      h.Set(k, h.ValueAt(k, h.Coordinate(k) + part * Normal(7, 5, number * h.free.size() + k)));
    return h;
  }

  const Case data_ = Clamped("heavy_compressor/rig.toml");
  CaseModel model_{data_};
  const Hypothesis nominal_ = Hypothesis::Base(data_.rig);
};

// A tenth of a sd and two of them change currents by twice as much, but for jumps: of the rows
// where they do not, by more than six floors, nearly all lie in branches, which are a small part of
// the currents.
TEST_F(BranchRowsTest, JumpsOfOtherDrawsLieInBranches) {
  model_.branches = RowsIn(model_, FindBranches(model_, nominal_));
  ASSERT_FALSE(model_.branches.empty());
  std::vector<char> branch(model_.size(), 0);
  for (const RowRange& rows : model_.branches)
    for (std::size_t k = rows.first; k < rows.first + rows.count; ++k) branch[k] = 1;
  EXPECT_LT(static_cast<double>(std::count(branch.begin(), branch.end(), 1)),
            0.15 * static_cast<double>(model_.size()));
  const std::vector<double> here = *model_.Predict(nominal_);
  std::size_t jumps = 0, known = 0;
  for (std::uint64_t draw = 0; draw < 24; ++draw) {
    const auto runs = model_.PredictAll({Drawn(draw, 0.2), Drawn(draw, 0.4)});
    for (const Target& t : model_.targets())
      for (std::size_t k = t.first; k < t.first + t.count; ++k) {
        const double bend = (*runs[1])[k] - 2 * (*runs[0])[k] + here[k];
        if (std::abs(bend) < 6 * t.floor) continue;
        ++jumps;
        known += branch[k];
      }
  }
  EXPECT_GT(jumps, 50U);
  EXPECT_GT(static_cast<double>(known), 0.8 * static_cast<double>(jumps)) << jumps;
}

TEST_F(BranchRowsTest, OneRemarkForEachRecordWithBranches) {
  const std::vector<BranchSpan> spans = FindBranches(model_, nominal_);
  std::vector<char> with(data_.records.size(), 0);
  for (const BranchSpan& s : spans) with[s.record] = 1;
  const std::vector<std::string> lines = BranchRemarks(model_, spans);
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(std::count(with.begin(), with.end(), 1)));
  EXPECT_NE(lines[0].find("limiter"), std::string::npos) << lines[0];
}

TEST_F(BranchRowsTest, WithoutTolerancesThereAreNone) {
  Hypothesis exact = nominal_;
  exact.free.clear();
  EXPECT_TRUE(FindBranches(model_, exact).empty());
}

class LimitedRowsTest : public ::testing::Test {
 protected:
  const Case data_ = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}});
  CaseModel model_{data_};
};

TEST_F(LimitedRowsTest, AnErrorCountsAsTwoFloorsAtMost) {
  model_.branches = {{100, 4}, {200, 4}};
  std::vector<double> r(model_.size(), 1.5);
  std::fill_n(r.begin() + 100, 4, -40.0);
  LimitInBranches(model_, r.data());
  for (std::size_t k = 0; k < r.size(); ++k)
    EXPECT_DOUBLE_EQ(r[k], k >= 100 && k < 104 ? -2.0 : 1.5);
}

TEST_F(LimitedRowsTest, AJumpTellsNoSlope) {
  model_.branches = {{100, 4}, {200, 4}};
  std::vector<double> change(model_.size(), 5.0);
  std::fill_n(change.begin() + 100, 2, 12.0);  // rms 9.2
  DropJumps(model_, change.data());
  for (std::size_t k = 0; k < change.size(); ++k)
    EXPECT_DOUBLE_EQ(change[k], k >= 100 && k < 104 ? 0.0 : 5.0);
}

// A span of samples is found again in a model that looks at every third row.
TEST_F(LimitedRowsTest, SpansHoldForThinnedModels) {
  const Target& t = model_.targets()[1];
  const std::vector<BranchSpan> spans = {{t.record, t.channel, 30, 59}};
  const std::vector<RowRange> all = RowsIn(model_, spans);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].first, t.first + 30);
  EXPECT_EQ(all[0].count, 30U);
  const CaseModel thin(data_, 3);
  const std::vector<RowRange> few = RowsIn(thin, spans);
  ASSERT_EQ(few.size(), 1U);
  EXPECT_EQ(few[0].count, 10U);
  for (std::size_t k = 0; k < few[0].count; ++k) {
    EXPECT_GE(thin.sample(few[0].first + k), 30U);
    EXPECT_LE(thin.sample(few[0].first + k), 59U);
  }
}

}  // namespace
}  // namespace ambrig
