// What a table says in a few numbers, from rows written by hand.
#include "campaign/merge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "tests/campaign/table_rows.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using testing::RowOf;

Row Finished(std::size_t run, const char* verdict, const char* judged, const char* detected,
             const char* right, const char* delay, const char* orbit) {
  return RowOf(run, {{"verdict", verdict},
                     {"failed", "8"},
                     {"judged", judged},
                     {"detected", detected},
                     {"right_class", right},
                     {"speed", "157.08"},
                     {"detection_delay", delay},
                     {"false_alarms", "1"},
                     {"coil_periods", "1000"},
                     {"peak_orbit", orbit},
                     {"reason", verdict == std::string("up") ? "" : "transition"}});
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
  EXPECT_EQ(n.reasons, (std::map<std::string, std::size_t>{{"transition", 2}}));
  EXPECT_EQ(n.largest_orbit, 3e-05);  // of the runs that stayed up
}

TEST(CountRows, OfNothingAreZero) {
  const RowCounts n = CountRows({});
  EXPECT_EQ(n.rows + n.up + n.drop + n.faults, 0u);
  EXPECT_EQ(n.worst_delay, 0);
}

TEST(Rows, ReadBackAsTheyWereWritten) {
  const Row row = Finished(7, "up", "1", "1", "1", "0.0002", "3e-05");
  const Row again = ParseRow(row.csv, "here");
  EXPECT_EQ(again.run, 7u);
  EXPECT_EQ(again.csv, row.csv);
  EXPECT_EQ(again.Cells(), row.Cells());
  EXPECT_EQ(again.Cells().size(), RowColumns().size());
  EXPECT_EQ(again.Number("detection_delay"), 0.0002);
  EXPECT_TRUE(std::isnan(again.Number("load")));
  EXPECT_THROW(again.At("colour"), std::logic_error);
}

std::string RefusalOf(const Row& row) {
  return testing::ErrorText<InputError>([&] { CheckRow(row, "journal.txt:2"); });
}

TEST(Rows, OfOtherCellsAreRefused) {
  const Row good = Finished(7, "up", "1", "1", "1", "0.0002", "3e-05");
  const Row few{7, good.csv.substr(0, good.csv.rfind(','))};
  EXPECT_EQ(RefusalOf(few), "journal.txt:2: 42 cells, allowed: 43 of a campaign's row");
  EXPECT_EQ(testing::ErrorText<InputError>([&] { few.At("note"); }),
            "row of run 7: 42 cells, allowed: 43 of a campaign's row");
  const auto with = [&](const char* column, const char* cell) {
    std::vector<std::string> cells;
    for (const std::string_view c : good.Cells()) cells.emplace_back(c);
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (RowColumns()[k].starts_with(column)) cells[k] = cell;
    return RefusalOf(RowOfCells(7, cells));
  };
  EXPECT_EQ(with("speed", ""), "journal.txt:2: speed = \"\", allowed: a number");
  EXPECT_EQ(with("load [", "1x"), "journal.txt:2: load = \"1x\", allowed: a number");
  EXPECT_EQ(with("failed", "-1"), "journal.txt:2: failed = \"-1\", allowed: a count");
  EXPECT_EQ(with("right_class", ""), "journal.txt:2: right_class = \"\", allowed: a count");
}

TEST(Rows, OfARunThatEndedInAnErrorHaveNoOutcome) {
  const Row row = RowOf(3, {{"verdict", "error"}, {"failed", "2"}, {"speed", "0"}, {"note", "x"}});
  EXPECT_NO_THROW(CheckRow(row, "here"));
}

// A header of 10^14 runs kept `merge` counting the ones that are missing.
TEST(Journals, OfMoreRunsThanACampaignHasAreRefused) {
  const testing::TemporaryFolder folder;
  for (const char* runs : {"99999999999999", "-1", "1e300", "0", "\"1\""}) {
    std::filesystem::remove(folder.File("journal.txt"));
    Journal(folder.File("journal.txt"),
            std::string(
                R"({"ambrig_campaign":1,"name":"t","file":"c.toml","fingerprint":"f","runs":)") +
                runs + "}",
            {});
    EXPECT_EQ(testing::ErrorText<InputError>([&] { MergeJournals({folder.File("")}, false); }),
              folder.File("") + "journal.txt:1: not a campaign's journal of this version")
        << runs;
  }
}

}  // namespace
}  // namespace ambrig
