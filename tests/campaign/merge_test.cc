// What a table says in a few numbers, from rows written by hand.
#include "campaign/merge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/campaign/table_rows.h"

namespace ambrig {
namespace {

using testing::RowOf;

Row Finished(std::size_t run, const char* verdict, const char* failed, const char* detected,
             const char* right, const char* delay, const char* orbit) {
  return RowOf(run, {{"verdict", verdict},
                     {"failed", failed},
                     {"detected", detected},
                     {"right_class", right},
                     {"detection_delay", delay},
                     {"false_alarms", "1"},
                     {"coil_periods", "1000"},
                     {"peak_orbit", orbit}});
}

TEST(CountRows, CountsVerdictsFaultsAndExtremes) {
  const Rows rows = {{0, Finished(0, "up", "1", "1", "1", "0.0002", "3e-05")},
                     {1, Finished(1, "touchdown", "2", "2", "1", "0.0005", "0.0002")},
                     {2, Finished(2, "drop", "2", "1", "1", "", "0.001")},
                     {3, RowOf(3, {{"verdict", "error"}, {"note", "no solution"}})}};
  const RowCounts n = CountRows(rows);
  EXPECT_EQ(n.rows, 4u);
  EXPECT_EQ(n.up, 1u);
  EXPECT_EQ(n.touchdown, 1u);
  EXPECT_EQ(n.drop, 1u);
  EXPECT_EQ(n.error, 1u);
  EXPECT_EQ(n.faults, 5u);
  EXPECT_EQ(n.undetected, 1u);
  EXPECT_EQ(n.wrong_class, 2u);
  EXPECT_EQ(n.false_alarms, 3);  // a run in error has none
  EXPECT_EQ(n.coil_periods, 3000);
  EXPECT_EQ(n.worst_delay, 0.0005);
  EXPECT_EQ(n.largest_orbit, 3e-05);  // of the runs that stayed up
}

TEST(CountRows, OfNothingAreZero) {
  const RowCounts n = CountRows({});
  EXPECT_EQ(n.rows + n.up + n.drop + n.faults, 0u);
  EXPECT_EQ(n.worst_delay, 0);
}

TEST(Rows, ReadBackAsTheyWereWritten) {
  const Row row = Finished(7, "up", "1", "1", "1", "0.0002", "3e-05");
  const Row again = ParseRow(row.Csv(), "here");
  EXPECT_EQ(again.run, 7u);
  EXPECT_EQ(again.cells, row.cells);
  EXPECT_EQ(again.Number("detection_delay"), 0.0002);
  EXPECT_TRUE(std::isnan(again.Number("load")));
  EXPECT_THROW(again.At("colour"), std::logic_error);
}

}  // namespace
}  // namespace ambrig
