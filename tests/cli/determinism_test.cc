/// Same scenario and seed, same bits: two runs, and any number of threads.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

class Determinism : public CliFolder {};

const std::string kLibrary = AMBRIG_SOURCE_DIR "/scenarios/library/";

// Noise, detection and redistribution on: the record is the same file, byte by byte.
TEST_F(Determinism, ARecordHasTheSameBytes) {
  for (const char* out : {"one", "two"})
    EXPECT_EQ(Ambrig("run " + kLibrary +
                     "coil_a3_opens_1500rpm.toml --quiet --csv --no-report --out " + out)
                  .exit,
              0);
  for (const char* file : {"coil_a3_opens_1500rpm.h5", "coil_a3_opens_1500rpm.csv"}) {
    const std::string one = ReadText(folder_ / "one" / file);
    EXPECT_GT(one.size(), 100000u);
    EXPECT_TRUE(one == ReadText(folder_ / "two" / file)) << file;
  }
}

// Not on what the cache holds of current distributions, nor on the folder, the language or the
// zone.
TEST_F(Determinism, CacheFolderAndLanguageDoNotMatter) {
  const std::filesystem::path other = folder_ / "a folder";
  std::filesystem::create_directories(other);
  const std::string scenario = ScenarioText(
      "[speed]\nprofile = [[0.0, 157.0]]\n[[fault]]\ntime = 0.003\ntarget = \"A.coil3\"\n"
      "kind = \"open\"\n");
  for (const std::string& prefix : {std::string(), std::string("a folder/")}) {
    Write(prefix + "rig.toml", ReferenceRigText());
    Write(prefix + "s.toml", scenario);
  }
  const std::string run =
      std::string(AMBRIG_BINARY) + " run s.toml --quiet --no-report --csv --out ";
  const std::string here =
      "cd " + folder_.string() + " && AMBRIG_CACHE=" + (folder_ / "cache").string() + " ";
  ASSERT_EQ(Shell(here + run + "cold").exit, 0);
  ASSERT_FALSE(std::filesystem::is_empty(folder_ / "cache"));
  ASSERT_EQ(Shell(here + run + "warm").exit, 0);
  ASSERT_EQ(Shell("cd '" + other.string() + "' && AMBRIG_CACHE=" + (folder_ / "none").string() +
                  " LC_ALL=de_DE.UTF-8 TZ=Asia/Tokyo " + run + "out")
                .exit,
            0);
  const std::string cold = ReadText(folder_ / "cold/s.csv");
  EXPECT_GT(cold.size(), 10000u);
  EXPECT_TRUE(cold == ReadText(folder_ / "warm/s.csv"));
  EXPECT_TRUE(cold == ReadText(other / "out/s.csv"));
  EXPECT_NE(ReadText(folder_ / "cold/s.json").find("redistributed"), std::string::npos);
  EXPECT_TRUE(ReadText(folder_ / "cold/s.h5") == ReadText(folder_ / "warm/s.h5"));
}

TEST_F(Determinism, AnotherSeedIsAnotherRecord) {
  Write("rig.toml", ReferenceRigText());
  for (const char* seed : {"1", "2"}) {
    Write("s.toml", ScenarioText(std::string("seed = ") + seed + "\n"));
    EXPECT_EQ(Ambrig(std::string("run s.toml --quiet --csv --no-report --out ") + seed).exit, 0);
  }
  EXPECT_FALSE(ReadText(folder_ / "1" / "s.csv") == ReadText(folder_ / "2" / "s.csv"));
}

// Another machine's mathematical library may round a sine otherwise (docs/theory/engine.md, "Same
// bits"): what is promised then is the same events and values within the tolerance of `ambrig
// diff`. The library of a processor without fused products and sums stands for that machine.
TEST_F(Determinism, AnotherMathematicalLibraryIsWithinRounding) {
  const std::string run = std::string(AMBRIG_BINARY) + " run " + kLibrary +
                          "coil_a3_opens_1500rpm.toml --quiet --no-report --out ";
  EXPECT_EQ(Shell("cd " + folder_.string() + " && " + run + "fused").exit, 0);
  EXPECT_EQ(Shell("cd " + folder_.string() +
                  " && GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2_Usable,-FMA_Usable " + run +
                  "plain")
                .exit,
            0);
  const Outcome o =
      Ambrig("diff fused/coil_a3_opens_1500rpm.h5 plain/coil_a3_opens_1500rpm.h5 --relative 1e-9");
  EXPECT_EQ(o.exit, 0) << o.text;
}

// Scenarios side by side on two threads give the figures of one thread, to the last digit.
TEST_F(Determinism, ChecksOfOneAndTwoJobs) {
  std::string files;
  for (const char* name : {"coil_a3_opens_1500rpm", "drop_at_1500rpm", "two_faults_in_sequence",
                           "switch_stuck_on", "lift_off"})
    files += " " + kLibrary + name + ".toml";
  nlohmann::json result[2];
  for (int jobs = 1; jobs <= 2; ++jobs) {
    const Outcome o = Ambrig("check" + files + " --json out.json --jobs " + std::to_string(jobs));
    EXPECT_EQ(o.exit, 0) << o.text;
    result[jobs - 1] = nlohmann::json::parse(ReadText(folder_ / "out.json"));
    for (auto& run : result[jobs - 1]) run["metrics"].erase("real_time_factor");
    result[jobs - 1][0]["provenance"].erase("argv");  // names the number of jobs
  }
  ASSERT_EQ(result[0].size(), 5u);
  EXPECT_GT(result[0][0]["metrics"]["peak_current"], 0);
  EXPECT_EQ(result[0], result[1]);
}

}  // namespace
}  // namespace ambrig
