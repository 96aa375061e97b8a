// Rows of a campaign while it runs: those behind a number, damaged ones left out.
#include "workbench/campaign_rows.h"

#include "core/base/errors.h"
#include "core/base/journal.h"
#include "tests/workbench/bench_folder.h"

namespace ambrig::workbench {
namespace {

class CampaignJournalRows : public BenchFolder {};

TEST_F(CampaignJournalRows, AreThoseBehindANumber) {
  const std::string folder = served();
  EXPECT_THROW(CampaignRows(folder, 0), InputError);
  Write("served/table.csv", "run,set,verdict\n");
  {
    Journal journal(folder + "/journal.txt", R"({"ambrig_campaign":1,"runs":3})",
                    {[](std::string_view) {}, [](const JournalEntry&) { return true; }});
    journal.Append("1,A:1,up");
    journal.Append("0,A:2,drop");
  }
  std::ofstream(folder + "/journal.txt", std::ios::app) << "2,A:3,up\tdamaged\n";
  const auto all = CampaignRows(folder, 0);
  EXPECT_EQ(all["columns"], (nlohmann::ordered_json{"run", "set", "verdict"}));
  EXPECT_EQ(all["runs"], 3);
  EXPECT_EQ(all["total"], 2);
  EXPECT_EQ(all["rows"], (nlohmann::ordered_json{"1,A:1,up", "0,A:2,drop"}));
  EXPECT_EQ(CampaignRows(folder, 1)["rows"], nlohmann::ordered_json{"0,A:2,drop"});
  EXPECT_TRUE(CampaignRows(folder, 7)["rows"].empty());
}

}  // namespace
}  // namespace ambrig::workbench
