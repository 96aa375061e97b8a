// A campaign of very many rows: what merge takes of the machine grows with the text of the rows,
// and by little beside it.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <filesystem>

#include "core/base/journal.h"
#include "tests/campaign/campaign_folder.h"
#include "tests/campaign/table_rows.h"

namespace ambrig::testing {
namespace {

constexpr std::size_t kFew = 1000, kMany = 41000;

/// The journal of a campaign of so many runs, as long as real rows are.
void WriteShard(const std::string& file, std::size_t runs) {
  Journal journal(
      file,
      R"({"ambrig_campaign":1,"name":"many","file":"/c.toml","fingerprint":"f","runs":)" +
          std::to_string(runs) + "}",
      {});
  for (std::size_t run = 0; run < runs; ++run)
    journal.Append(RowOf(run, {{"scenario", "levitated"},
                               {"set", "A:1+3"},
                               {"failed", "2"},
                               {"class", "linearised"},
                               {"kind", run % 2 == 0 ? "open" : "partial-short fraction=0.5"},
                               {"onset", "simultaneous"},
                               {"fault_time", "0.001"},
                               {"speed", std::to_string(100 * (run % 7))},
                               {"load_given", "0.8"},
                               {"load", "20.751761532972486"},
                               {"capacity", "51.879403832431215"},
                               {"draw", "0"},
                               {"seed", std::to_string(1135186513210162 + run)},
                               {"verdict", "up"},
                               {"judged", "2"},
                               {"detected", "2"},
                               {"right_class", "2"},
                               {"detection_delay", "0.0001200000000000001"},
                               {"redistribution_delay", "0.0001200000000000001"},
                               {"false_alarms", "0"},
                               {"coil_periods", "1000"},
                               {"peak_orbit", "2.344810745602446e-06"},
                               {"bearing_orbit", "2.344810745602446e-06"},
                               {"late_orbit", "2.344810745602446e-06"},
                               {"clearance_left", "0.00019765518925439756"},
                               {"longest_contact", "0"},
                               {"peak_current", "4.268197766116703"},
                               {"copper_loss", "39.58930587880142"},
                               {"doubtful", "no"},
                               {"doubtful_share", "0.0123456789012345"}})
                       .csv);
}

/// Largest memory of `ambrig merge FOLDER -o OUT` [bytes]; 0 where it failed.
double MemoryOfMerge(const std::string& folder, const std::string& out) {
  const std::string program = AMBRIG_BINARY;
  const char* const words[] = {program.c_str(), "merge", folder.c_str(), "-o",
                               out.c_str(),     nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, const_cast<char* const*>(words),
                  environ) != 0)
    return 0;
  int status = 0;
  rusage used = {};
  wait4(child, &status, 0, &used);
  return status == 0 ? 1024.0 * static_cast<double>(used.ru_maxrss) : 0;
}

TEST(ManyRows, MergeKeepsLittleMoreThanTheirText) {
#ifdef AMBRIG_SANITIZED
  GTEST_SKIP() << "the sanitizers keep memory of their own for every block";
#endif
  const CampaignFolder f;
  WriteShard(f.File("few/journal.txt"), kFew);
  WriteShard(f.File("many/journal.txt"), kMany);
  const double few = MemoryOfMerge(f.File("few"), f.File("few_all"));
  const double many = MemoryOfMerge(f.File("many"), f.File("many_all"));
  ASSERT_GT(few, 0);
  ASSERT_GT(many, 0);
  // Beside its text a row has its place in the map and what malloc adds to both.
  const double text = static_cast<double>(f.Read("many_all/table.csv").size()) / kMany;
  EXPECT_GT(text, 300);
  EXPECT_LT((many - few) / (kMany - kFew), text + 250);
  // The report grows with what is told apart, not with the rows.
  const auto size = [&](const char* folder) {
    return static_cast<double>(std::filesystem::file_size(f.File(folder) + "/report.html"));
  };
  EXPECT_LT(size("many_all") - size("few_all"), 20000);
}

}  // namespace
}  // namespace ambrig::testing
