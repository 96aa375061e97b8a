// Corrections of records from amounts that are written down.
#include "discovery/explain/record_corrections.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Clocks late by these numbers of rows of the records.
std::vector<NuisanceFound> ShiftsOf(const Case& c, const std::vector<double>& rows) {
  std::vector<NuisanceFound> found;
  for (std::size_t r = 0; r < rows.size(); ++r)
    found.push_back({c.records[r].data_file, kTimeShift, "s", rows[r] / c.records[r].data.rate, 0});
  return found;
}

// Rows of 1 ms hold 25 switching periods, rows of 20 us are shorter than one.
TEST(LateClocks, AreWholeSwitchingPeriodsOrRows) {
  Case c = LinearCase::Make({1e-5, 2e-5, 3e-5}, 1, 0);
  const double period = 1 / c.rig.amplifier.switching_frequency;
  for (CaseRecord& r : c.records) r.data.rate = 1 / (25 * period);
  const auto late = LateClocks(c, ShiftsOf(c, {0.1, 1.81, -1.23}));
  ASSERT_TRUE(late.has_value());
  EXPECT_NEAR((*late)[0], 3 * period, 1e-12);  // 2.5: rounded away from zero
  EXPECT_NEAR((*late)[1], 45 * period, 1e-12);
  EXPECT_NEAR((*late)[2], -31 * period, 1e-12);
  for (CaseRecord& r : c.records) r.data.rate = 2 / period;
  const auto rows = LateClocks(c, ShiftsOf(c, {0.1, 1.8, -1.2}));
  ASSERT_TRUE(rows.has_value());
  EXPECT_NEAR((*rows)[0], 0, 1e-12);
  EXPECT_NEAR((*rows)[1], period, 1e-12);
  EXPECT_NEAR((*rows)[2], -0.5 * period, 1e-12);
}

TEST(LateClocks, ADelayOfTheRigIsTheSameInAllRecords) {
  const Case c = LinearCase::Make({1e-5, 2e-5, 3e-5}, 1, 0);
  EXPECT_FALSE(LateClocks(c, ShiftsOf(c, {2, 2.1, 1.9})).has_value());
  EXPECT_FALSE(LateClocks(c, ShiftsOf(c, {0.2, -0.3, 0.4})).has_value());
}

// Four rows, or half a millisecond where that is more: larger shifts are a matter of the data gate.
TEST(LateClocks, MoreThanHalfAMillisecondIsNotMoved) {
  Case c = LinearCase::Make({1e-5, 2e-5, 3e-5}, 1, 0);
  const double rate = c.rig.amplifier.switching_frequency;
  const auto rows = [&](const std::vector<double>& shifts) {
    std::vector<double> late = LateClocks(c, ShiftsOf(c, shifts)).value();
    for (double& l : late) l = std::round(l * c.records[0].data.rate);
    return late;
  };
  for (CaseRecord& r : c.records) r.data.rate = rate;
  EXPECT_THAT(rows({0, 13, 14}), ElementsAre(0, 13, 0));
  for (CaseRecord& r : c.records) r.data.rate = rate / 10;
  EXPECT_THAT(rows({0, 4, 5}), ElementsAre(0, 4, 0));
}

TEST(RecordCorrections, SizesOfInputsMultiplyAndClocksAreTheLastOnes) {
  RecordCorrections all;
  EXPECT_FALSE(all.any());
  all.Add({{0, 4e-5}, {}});
  all.Add({{}, {0.1, 0}});
  all.Add({{}, {0.2, -0.5}});
  EXPECT_THAT(all.clocks_late, ElementsAre(0, 4e-5));
  EXPECT_NEAR(all.inputs_larger[0], 1.1 * 1.2 - 1, 1e-15);
  EXPECT_NEAR(all.inputs_larger[1], -0.5, 1e-15);
}

TEST(ReportCorrections, AddsToTheSizeFoundOrWarns) {
  const Case c = LinearCase::Make({1e-5, 2e-5, 3e-5}, 1, 0);
  Explanation e;
  e.nuisances = {{c.records[0].data_file, kInputGain, "-", 0.01, 0.001}};
  const double row = 1 / c.records[1].data.rate;
  ReportCorrections(c, {{0, -row, 0.25 * row}, {0.1, 0, -0.02}}, e);
  EXPECT_NEAR(e.nuisances[0].value, 1.1 * 1.01 - 1, 1e-15);
  ASSERT_THAT(e.warnings, SizeIs(3));
  EXPECT_THAT(e.warnings[0], HasSubstr("the clock of at 2e-05 m is 1 row early"));
  EXPECT_THAT(e.warnings[1], HasSubstr("the clock of at 3e-05 m is "));
  EXPECT_THAT(e.warnings[1], HasSubstr(" ms late"));
  EXPECT_THAT(e.warnings[2], HasSubstr("the commands of at 3e-05 m are 2.00 % smaller"));
}

// Two statements on one clock would have to be added by the reader.
TEST(ReportCorrections, AddsTheRowsMovedToTheShiftFound) {
  const Case c = LinearCase::Make({1e-5, 2e-5, 3e-5}, 1, 0);
  const double row = 1 / c.records[1].data.rate;
  Explanation e;
  e.nuisances = {{c.records[1].data_file, kTimeShift, "s", -1.9 * row, 0.01 * row}};
  ReportCorrections(c, {{0, 2 * row, 0}, {}}, e);
  EXPECT_NEAR(e.nuisances[0].value, 0.1 * row, 1e-12 * row);
  EXPECT_TRUE(e.warnings.empty());
}

}  // namespace
}  // namespace ambrig
