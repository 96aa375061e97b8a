// ambrig crosscheck: table, JSON, report, exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Outcome {
  int exit = 0;
  std::string text;
};

class WitnessCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ambrig_witness_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome Witness(const std::string& arguments) const {
    Outcome out;
    FILE* pipe =
        popen((std::string(AMBRIG_BINARY) + " crosscheck " + arguments + " 2>&1").c_str(), "r");
    char buffer[512];
    while (std::fgets(buffer, sizeof buffer, pipe)) out.text += buffer;
    out.exit = WEXITSTATUS(pclose(pipe));
    return out;
  }
  std::string Text(const std::string& name) const {
    std::ifstream in(folder_ / name);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder_;
  const std::string library_ = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/";
};

TEST_F(WitnessCommand, WritesTableJsonAndReport) {
  const std::string json = (folder_ / "w.json").string(), html = (folder_ / "w.html").string();
  const Outcome o = Witness(library_ + "fault_at_sixty_percent_orbit.toml " + library_ +
                            "lift_off.toml --seeds 2 --json " + json + " --html " + html);
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("agree   A3 opens while the shaft whirls"));
  EXPECT_THAT(o.text, HasSubstr("of 2 seeds: 0 dropped, 0 backward, 2 forward"));
  EXPECT_THAT(o.text, HasSubstr("4 runs, 4 with contact, differing verdicts: 0"));
  const auto all = nlohmann::json::parse(Text("w.json"));
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0]["compliant"]["verdict"], "touched down");
  EXPECT_EQ(all[0]["ode"]["whirl"], "forward");
  EXPECT_EQ(all[0]["other_noise"]["first_touched"], "A");
  EXPECT_EQ(all[1]["seed"], 2);
  EXPECT_FALSE(all[1].contains("other_noise"));
  EXPECT_TRUE(all[2]["verdicts_agree"]);
  const std::string page = Text("w.html");
  EXPECT_THAT(page, HasSubstr("Both models agree: touched down."));
  EXPECT_THAT(page, HasSubstr("lift-off from the auxiliary bearings"));
}

TEST_F(WitnessCommand, ComplainsInOneLine) {
  const std::string json = (folder_ / "w.json").string();
  for (const std::string& arguments :
       {std::string("nowhere.toml"), library_ + "lift_off.toml --step 50",
        library_ + "lift_off.toml --seeds 0", library_ + "rigs/reference.toml"}) {
    const Outcome o = Witness(arguments + " --json " + json);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(std::count(o.text.begin(), o.text.end(), '\n'), 1) << o.text;
    EXPECT_FALSE(fs::exists(json));
  }
}

}  // namespace
