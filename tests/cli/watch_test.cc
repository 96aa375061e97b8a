// ambrig watch: a rig that does not change stays within its bands, one that does is told with what
// changed; every record is examined once.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/base/journal.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A ball under a magnet whose coil is driven by measured duties (examples/mls2em); records are
/// simulated.
class Watch : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    fs::copy(AMBRIG_SOURCE_DIR "/examples/mls2em", folder_, fs::copy_options::recursive);
    Write("known.toml",
          "rig = \"rig.toml\"\nnoise = { \"M.i1\" = 0.0065 }\n[[record]]\nscenario = "
          "\"steps-05.toml\"\ndata = \"known/steps-05.h5\"\nchannels = { \"M.fx\" = { column = "
          "\"M.fx\", use = false } }\n");
    Make("known/steps-05.h5", "rig.toml", 1);
    fs::create_directories(folder_ / "logger");
  }
  /// A record of the scenario with this rig and seed.
  void Make(const std::string& data, const std::string& rig, int seed) const {
    Write("now.toml",
          "seed = " + std::to_string(seed) + "\n" +
              Replaced(ReadText(folder_ / "steps-05.toml"), "\"rig.toml\"", "\"" + rig + "\""));
    EXPECT_EQ(Ambrig("run now.toml --no-report --quiet --out made").exit, 0);
    fs::create_directories((folder_ / data).parent_path());
    fs::rename(folder_ / "made/now.h5", folder_ / data);
  }
  /// The same as CSV, with the cells of the current's column as `cell` makes them.
  void MakeCsv(const std::string& data,
               const std::function<std::string(std::size_t, const std::string&)>& cell) const {
    EXPECT_EQ(Ambrig("run steps-05.toml --no-report --quiet --csv --out made").exit, 0);
    std::istringstream rows(ReadText(folder_ / "made/steps-05.csv"));
    std::string text, line;
    std::size_t current = 0;
    for (std::size_t row = 0; std::getline(rows, line); ++row) {
      std::istringstream cells(line);
      std::string one;
      for (std::size_t column = 0; std::getline(cells, one, ','); ++column) {
        if (row == 0 && one.starts_with("M.i1")) current = column;
        text += (column == 0 ? "" : ",") + (row > 0 && column == current ? cell(row, one) : one);
      }
      text += '\n';
    }
    EXPECT_GT(current, 0u);
    Write(data, text);
  }
  nlohmann::json Look(int exit, const std::string& more = "") {
    const Outcome o =
        Ambrig("watch known.toml logger --settle 0 --json w.json --html w.html --force " + more);
    EXPECT_EQ(o.exit, exit) << o.text;
    text_ = o.text;
    return nlohmann::json::parse(ReadText(folder_ / "w.json"));
  }
  std::string text_;
};

TEST_F(Watch, TellsWhatChangedAndNothingElse) {
  Make("logger/steps-05-april.h5", "rig.toml", 2);
  nlohmann::json w = Look(0);
  ASSERT_EQ(w["records"].size(), 1u);
  EXPECT_EQ(w["records"][0]["state"], "ok") << w["records"][0]["left"];
  EXPECT_EQ(w["records"][0]["of"], "steps-05");
  // Two of the four channels, duty and bus, are simulated without noise: their error is zero.
  EXPECT_NEAR(w["records"][0]["ratio_fitted"], std::sqrt(0.5), 0.07);
  EXPECT_EQ(w["alarm"], false);
  // The coil is a tenth warmer than copper at the reference: R 4.17 -> 4.6 ohm.
  Write("warm.toml",
        Replaced(ReadText(folder_ / "rig.toml"), "resistance = { value = 4.17, sd = 0.05 }",
                 "resistance = { value = 4.17, sd = 0.05, fitted = 4.6 }"));
  Make("logger/steps-05-june.h5", "warm.toml", 3);
  w = Look(1);
  ASSERT_EQ(w["new"], nlohmann::json{"steps-05-june.h5"});  // april was examined before
  const nlohmann::json& june = w["records"][1];
  EXPECT_EQ(june["state"], "left");
  bool resistance = false;
  for (const auto& b : june["left"]) resistance |= b["name"] == "bearings.M.resistance";
  EXPECT_TRUE(resistance) << june["left"];
  EXPECT_GT(june["ratio"].get<double>(), 2);  // with the reference's parameters
  EXPECT_TRUE(june.contains("explanation")) << text_;
  EXPECT_THAT(text_, HasSubstr("explained by"));
  const std::string page = ReadText(folder_ / "w.html");
  EXPECT_THAT(page, HasSubstr("bearings.M.resistance"));
  EXPECT_THAT(page, HasSubstr("closure"));
  // Nothing new: no alarm again.
  w = Look(0);
  EXPECT_TRUE(w["new"].empty());
  EXPECT_EQ(w["records"].size(), 2u);
  EXPECT_THAT(text_, HasSubstr("nothing new"));
}

TEST_F(Watch, WrongDataAndStrangeFilesAreToldNotFitted) {
  Make("logger/steps-05-may.h5", "rig.toml", 2);
  Write("logger/broken.csv", "t,x\n0,1\nno number\n");
  Write("logger/notes.md", "not a record\n");
  nlohmann::json w = Look(1, "--no-explain");
  ASSERT_EQ(w["records"].size(), 2u) << w["records"];
  for (const auto& r : w["records"])
    EXPECT_EQ(r["state"], r["data"] == "broken.csv" ? "refused" : "ok") << r;
}

// One sample of 1e308 A makes the error infinite, which JSON has no word for: the alarm is told all
// the same, and once.
TEST_F(Watch, AnInfiniteErrorIsAnAlarm) {
  MakeCsv("logger/steps-05-spike.csv",
          [](std::size_t row, const std::string& cell) { return row == 700 ? "1e308" : cell; });
  const nlohmann::json w = Look(1, "--no-explain");
  ASSERT_EQ(w["records"].size(), 1u);
  EXPECT_EQ(w["records"][0]["state"], "data") << w["records"][0];
  EXPECT_THAT(text_, HasSubstr("the data are wrong"));
  EXPECT_EQ(w["alarm"], true);
}

// A sensor whose cable is off agrees with everything: it is told, not passed over.
TEST_F(Watch, ADeadChannelIsAnAlarm) {
  MakeCsv("logger/steps-05-dead.csv", [](std::size_t, const std::string&) { return ""; });
  const nlohmann::json w = Look(1, "--no-explain");
  ASSERT_EQ(w["records"].size(), 1u);
  EXPECT_NE(w["records"][0]["state"], "ok") << w["records"][0];
  EXPECT_THAT(text_, HasSubstr("M.i1"));
}

// What a crash left in the journal counts as it is: a damaged entry is examined again.
TEST_F(Watch, ADamagedEntryIsExaminedAgain) {
  Make("logger/steps-05-may.h5", "rig.toml", 2);
  const nlohmann::json first = Look(0);
  const std::string journal = ReadText(folder_ / "known.watch");
  Write("known.watch", journal.substr(0, journal.size() - 20));
  const nlohmann::json again = Look(0);
  EXPECT_EQ(again["new"], nlohmann::json{"steps-05-may.h5"});
  EXPECT_EQ(again["records"][0]["parameters"], first["records"][0]["parameters"]);  // the same bits
}

// Entries whose check sums fit but that have not what is looked up: of another version, or by hand.
TEST_F(Watch, EntriesOfOtherShapeAreLeftOut) {
  Make("logger/steps-05-may.h5", "rig.toml", 2);
  {
    Journal journal((folder_ / "known.watch").string(), "ambrig watch 1 known.toml", {});
    for (const char* entry :
         {"[]", R"({"kind":"record"})", R"({"kind":"reference"})",
          R"({"kind":"record","model":"m","data":"steps-05-may.h5"})",
          R"({"kind":"record","model":"m","data":"x","hash":"h","size":1,"changed":1,"left":[1]})"})
      journal.Append(entry);
  }
  EXPECT_EQ(Look(0)["new"], nlohmann::json{"steps-05-may.h5"});
}

TEST_F(Watch, FilesThatAreStillWrittenToWait) {
  Make("logger/steps-05-may.h5", "rig.toml", 2);
  const Outcome o = Ambrig("watch known.toml logger --settle 3600 --json w.json");
  EXPECT_EQ(o.exit, 0) << o.text;
  const auto w = nlohmann::json::parse(ReadText(folder_ / "w.json"));
  EXPECT_EQ(w["waiting"], nlohmann::json{"steps-05-may.h5"});
  EXPECT_TRUE(w["records"].empty());
}

TEST_F(Watch, MistakesAreOneLine) {
  EXPECT_EQ(Ambrig("watch known.toml nowhere").exit, 2);
  Write("known.watch", "mine\n");
  const Outcome o = Ambrig("watch known.toml logger");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_EQ(ReadText(folder_ / "known.watch"), "mine\n");
}

}  // namespace
}  // namespace ambrig
