// ambrig campaign, merge and run --from-campaign as a user sees them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "campaign/journal.h"
#include "campaign/merge.h"
#include "nlohmann/json.hpp"
#include "tests/campaign/campaign_folder.h"

namespace ambrig::testing {
namespace {

namespace fs = std::filesystem;

std::size_t Lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(CampaignCommand, SameBytesForAnyJobsAndShards) {
  const CampaignFolder f;
  const Outcome one = f.Ambrig("campaign c.toml -o one --jobs 1 --no-report");
  ASSERT_EQ(one.exit, 0) << one.text;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o three --jobs 3 --no-report").exit, 0);
  ASSERT_EQ(f.Ambrig("campaign c.toml -o p1 --shard 1/3 --no-report").exit, 0);
  ASSERT_EQ(f.Ambrig("campaign c.toml -o p3 --shard 3/3 --no-report").exit, 0);
  const Outcome missing = f.Ambrig("merge p1 p3 -o all");
  EXPECT_EQ(missing.exit, 2);
  EXPECT_NE(missing.text.find("11 of 32 runs are missing (1, 4, 7, 10, 13, ...)"),
            std::string::npos)
      << missing.text;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o p2 --shard 2/3 --no-report").exit, 0);
  const Outcome merged = f.Ambrig("merge p3 p1 p2 -o all");
  ASSERT_EQ(merged.exit, 0) << merged.text;
  const std::string table = f.Read("one/table.csv");
  EXPECT_EQ(Lines(table), 33u);
  EXPECT_EQ(table, f.Read("three/table.csv"));
  EXPECT_EQ(table, f.Read("all/table.csv"));
  EXPECT_TRUE(fs::exists(f.File("all/report.html")));
}

TEST(CampaignCommand, KillLosesNoFinishedRunAndResumesToTheSameBytes) {
  const CampaignFolder f;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o whole --no-report").exit, 0);
  // Killed as soon as five rows are there.
  const Outcome killed = f.In(std::string(AMBRIG_BINARY) +
                              " campaign c.toml -o cut --jobs 2 --no-report & p=$!; "
                              "for k in $(seq 1500); do [ $(cat cut/journal.txt 2>/dev/null | wc "
                              "-l) -lt 6 ] || break; sleep 0.02; done; kill -9 $p; wait $p; true");
  ASSERT_EQ(killed.exit, 0) << killed.text;
  const Rows before = ReadJournal(f.File("cut")).rows;
  ASSERT_GE(before.size(), 5u);
  ASSERT_LT(before.size(), 32u) << "killed too late to show anything";
  // No table of a part: only its header, for whoever follows the journal.
  const std::string header = f.Read("cut/table.csv");
  EXPECT_EQ(header.find('\n'), header.size() - 1) << header;
  const std::string kept = f.Read("cut/journal.txt");
  const Outcome resumed = f.Ambrig("campaign c.toml -o cut --no-report");
  ASSERT_EQ(resumed.exit, 0) << resumed.text;
  EXPECT_NE(resumed.text.find("resumed, " + std::to_string(before.size()) + " runs"),
            std::string::npos)
      << resumed.text;
  // nothing was done twice
  EXPECT_TRUE(f.Read("cut/journal.txt").starts_with(kept.substr(0, kept.rfind('\n'))));
  EXPECT_EQ(Lines(f.Read("cut/journal.txt")), 33u + (kept.ends_with('\n') ? 0u : 1u));
  EXPECT_EQ(f.Read("cut/table.csv"), f.Read("whole/table.csv"));
}

TEST(CampaignCommand, WriteThatFailsStopsWithOneLineAndLosesNothing) {
  const CampaignFolder f;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o whole --no-report").exit, 0);
  // A limit on the size of a file: the last line is cut off, as on a full disk.
  const Outcome full = f.In(std::string("trap '' XFSZ; ulimit -f 4; ") + AMBRIG_BINARY +
                            " campaign c.toml -o cut --no-report");
  EXPECT_EQ(full.exit, 2) << full.text;
  EXPECT_NE(full.text.find("cannot write cut/journal.txt: File too large"), std::string::npos)
      << full.text;
  EXPECT_EQ(Lines(full.text), 1u) << full.text;
  const JournalContent content = ReadJournal(f.File("cut"));
  EXPECT_GT(content.rows.size(), 1u);
  EXPECT_LT(content.rows.size(), 32u);
  ASSERT_EQ(f.Ambrig("campaign c.toml -o cut --no-report").exit, 0);
  EXPECT_EQ(f.Read("cut/table.csv"), f.Read("whole/table.csv"));
  EXPECT_EQ(f.Ambrig("campaign c.toml -o cut --no-report --json /dev/full").exit, 2);
}

TEST(CampaignCommand, DamagedLinesAreDoneAgain) {
  const CampaignFolder f;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o out --no-report").exit, 0);
  const std::string table = f.Read("out/table.csv");
  std::string journal = f.Read("out/journal.txt");
  const auto at = journal.find("open");
  journal[at] = 'O';
  f.Write("out/journal.txt", journal.substr(0, journal.size() - 20));
  const Outcome again = f.Ambrig("campaign c.toml -o out --no-report");
  EXPECT_NE(again.text.find("resumed, 30 runs done before, 2 damaged lines done again"),
            std::string::npos)
      << again.text;
  EXPECT_EQ(f.Read("out/table.csv"), table);
}

// A row of another version of the program, whole and with its check sum: file and line say where it
// stands.
TEST(CampaignCommand, ARowOfOtherCellsIsRefusedWithItsLine) {
  const CampaignFolder f;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o out --shard 1/16 --no-report").exit, 0);
  Journal(f.File("out/journal.txt"), "",
          {.header = [](std::string_view) {}, .entry = [](const JournalEntry&) { return true; }})
      .Append("5,levitated,A:1");
  const Outcome refused = f.Ambrig("campaign c.toml -o out --no-report");
  EXPECT_EQ(refused.exit, 2);
  EXPECT_EQ(refused.text, "ambrig: out/journal.txt:4: 3 cells, allowed: 43 of a campaign's row\n");
}

TEST(CampaignCommand, ChangedCampaignOrRigIsRefused) {
  const CampaignFolder f;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o out --shard 1/8 --no-report").exit, 0);
  const std::string rig = f.Read("rig.toml");
  f.Write("rig.toml", rig + "\n# another word\n");
  const Outcome changed = f.Ambrig("campaign c.toml -o out --no-report");
  EXPECT_EQ(changed.exit, 2);
  EXPECT_NE(changed.text.find("its rig or a scenario was changed"), std::string::npos)
      << changed.text;
  f.Write("rig.toml", rig);
  f.Write("c.toml", std::string(kSmallCampaign) + "scale = 0.5\n");
  EXPECT_EQ(f.Ambrig("campaign c.toml -o out --no-report").exit, 2);
  ASSERT_EQ(f.Ambrig("campaign c.toml -o other --shard 1/8 --no-report").exit, 0);
  EXPECT_NE(f.Ambrig("merge out other -o all").text.find("another campaign"), std::string::npos);
}

TEST(CampaignCommand, ARowRunsAgainWithTheSameFigures) {
  const CampaignFolder f;
  ASSERT_EQ(f.Ambrig("campaign c.toml -o out --no-report --shard 6/32").exit, 0);
  const Row row = ReadJournal(f.File("out")).rows.at(5);
  const Outcome run = f.Ambrig("run --from-campaign c.toml --row 5 --no-report --out again");
  ASSERT_EQ(run.exit, 0) << run.text;
  const auto json = nlohmann::json::parse(f.Read("again/c_row_5.json"));
  EXPECT_EQ(std::to_string(json["seed"].get<std::uint64_t>()), row.At("seed"));
  EXPECT_EQ(json["metrics"]["max_orbit"]["A"].get<double>(), row.Number("bearing_orbit"));
  EXPECT_EQ(json["metrics"]["copper_loss"].get<double>(), row.Number("copper_loss"));
  EXPECT_EQ(json["metrics"]["peak_current"].get<double>(), row.Number("peak_current"));
  EXPECT_EQ(json["metrics"]["detection_delay"].get<double>(), row.Number("detection_delay"));
  EXPECT_EQ(f.Ambrig("run --from-campaign c.toml --row 32").exit, 2);
}

TEST(CampaignCommand, WrongOptionsAreSaidInOneLine) {
  const CampaignFolder f;
  for (const char* options :
       {"--shard 0/2", "--shard 3/2", "--shard 1", "--shard a/b", "--shard -1/2", "--jobs 0",
        "--engine pbs", "--engine slurm --shard 1/2", "--tasks 2000 --engine slurm"}) {
    const Outcome o = f.Ambrig(std::string("campaign c.toml -o out ") + options);
    EXPECT_EQ(o.exit, 2) << options << o.text;
    EXPECT_EQ(Lines(o.text), 1u) << options << o.text;
  }
  for (const char* command : {"run --row 3", "run", "run --from-campaign c.toml", "merge . -o out",
                              "campaign none.toml"}) {
    const Outcome o = f.Ambrig(command);
    EXPECT_EQ(o.exit, 2) << command << o.text;
    EXPECT_EQ(Lines(o.text), 1u) << command << o.text;
  }
  EXPECT_FALSE(fs::exists(f.File("out")));
}

TEST(CampaignCommand, FolderInUseIsRefused) {
  const CampaignFolder f;
  const Campaign c = ReadCampaign(f.File("c.toml"));
  const CampaignJournal journal(f.File("out"), HeaderOf(c));
  const Outcome second = f.Ambrig("campaign c.toml -o out");
  EXPECT_EQ(second.exit, 2);
  EXPECT_NE(second.text.find("another ambrig writes there"), std::string::npos) << second.text;
}

// The small version of scenarios/campaigns/survival.toml: what theory calls exact with capacity for
// the weight survives open coils; a bearing without coils cannot.
TEST(CampaignCommand, SmallSurvivalCampaign) {
  const CampaignFolder f;
  const std::string campaign =
      std::string(AMBRIG_SOURCE_DIR) + "/scenarios/campaigns/survival_small.toml";
  const Outcome o = f.Ambrig("campaign " + campaign + " -o out");
  ASSERT_EQ(o.exit, 0) << o.text;
  const Rows rows = ReadJournal(f.File("out")).rows;
  EXPECT_EQ(rows.size(), 44u);
  std::size_t held = 0;
  for (const auto& [run, row] : rows) {
    const std::string what = row.At("set") + " " + row.At("kind") + " " + row.At("onset") +
                             " load " + row.At("load_given");
    EXPECT_NE(row.At("verdict"), "error") << what << row.At("note");
    EXPECT_EQ(row.Number("false_alarms"), 0) << what;
    // What drops is what theory says cannot be carried.
    EXPECT_EQ(row.At("reason"), row.At("verdict") == "up" ? "" : "load not carried") << what;
    if (row.Number("margin") >= 1.3) {
      EXPECT_EQ(row.At("verdict"), "up") << what;
    }
    if (row.At("kind") != "open") continue;
    if (row.Number("capacity") > 30) {
      EXPECT_EQ(row.At("verdict"), "up") << what;
      ++held;
    }
    if (row.Number("failed") == 8) {
      EXPECT_NE(row.At("verdict"), "up") << what;
    }
  }
  EXPECT_EQ(held, 14u);  // {3}, {1,2}, {1,5}, {2,4,6,8}
  EXPECT_NE(f.Read("out/report.html").find("Survival: open, 1500 rpm"), std::string::npos);
}

// Half of the turns of A7 go while it carries next to no current. Its command (0.12 to 0.39 A,
// limit 0.3 A) crosses the limit of idle coils every few milliseconds; it is probed again all the
// same.
TEST(CampaignCommand, AnIdleCoilWhoseCommandIsNearTheLimitIsProbedAgain) {
  const CampaignFolder f;
  const Outcome o = f.Ambrig("run --from-campaign " + std::string(AMBRIG_SOURCE_DIR) +
                             "/scenarios/campaigns/survival.toml --row 6479 --out out");
  ASSERT_EQ(o.exit, 0) << o.text;
  for (const char* coil : {"A.coil1", "A.coil3", "A.coil4", "A.coil5", "A.coil7"})
    EXPECT_NE(o.text.find(std::string("detected       ") + coil), std::string::npos) << coil;
  EXPECT_NE(o.text.find("false alarms           0"), std::string::npos) << o.text;
}

// Rows of single_coils.toml in which the size of a bypassed half was once told again, by a grid of
// sizes coarser than what was known: the shaft was pushed 8 um aside.
TEST(CampaignRows, TheSizeOfAHalfShortStaysWhereTheBalanceDoesNotTellBetter) {
  const CampaignFolder f;
  for (const char* row : {"326", "484", "519"}) {
    const Outcome o = f.Ambrig("run --from-campaign " + std::string(AMBRIG_SOURCE_DIR) +
                               "/scenarios/campaigns/single_coils.toml --out out --row " + row);
    ASSERT_EQ(o.exit, 0) << o.text;
    const std::string name = std::string("out/single_coils_row_") + row + ".json";
    const auto json = nlohmann::json::parse(f.Read(name));
    EXPECT_LT(json.at("metrics").at("max_orbit").at("A").get<double>(), 4e-6) << row;
  }
}

TEST(CampaignFiles, AllOfTheRepositoryCanBeRead) {
  for (const char* name : {"single_coils", "survival", "survival_small", "false_alarms"})
    EXPECT_GT(
        ReadCampaign(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/campaigns/" + name + ".toml")
            .runs(),
        0u)
        << name;
}

}  // namespace
}  // namespace ambrig::testing
