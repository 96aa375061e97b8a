// The tutorials of docs/guide, run: every line that starts with "ambrig" (and the copies and edits
// between them) as it stands on the page, and what the page says comes out.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string Read(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// A tutorial of a minute of computing runs with AMBRIG_SLOW_TESTS=1 only.
bool IsLeftToNightly() { return std::getenv("AMBRIG_SLOW_TESTS") == nullptr; }

class Tutorial : public ::testing::Test {
 protected:
  void SetUp() override {
    // Of this process: the same test may run from another clone at the same time.
    folder_ = fs::temp_directory_path() /
              ("ambrig_tutorial_" + std::to_string(::getpid()) + "_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    setenv("PATH",
           (fs::path(AMBRIG_BINARY).parent_path().string() + ":" + std::getenv("PATH")).c_str(), 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Runs the page's commands in the folder, in order.
  void Follow(const std::string& page) const {
    std::istringstream in(Read(fs::path(AMBRIG_SOURCE_DIR) / "docs/guide" / page));
    int commands = 0;
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("    ambrig ") && !line.starts_with("    sed ") &&
          !line.starts_with("    cat "))
        continue;
      const std::string command =
          "cd " + folder_.string() + " && ( " + line.substr(4) + " ) > log.txt 2>&1";
      const int status = std::system(command.c_str());
      ASSERT_EQ(WEXITSTATUS(status), 0) << line << "\n" << Read(folder_ / "log.txt");
      ++commands;
    }
    EXPECT_GE(commands, 4) << page;
  }
  void ExpectSolenoidsSleeve() const;
  nlohmann::json Json(const std::string& file) const {
    return nlohmann::json::parse(Read(folder_ / file));
  }

  fs::path folder_;
};

TEST_F(Tutorial, HiddenEffect) {
  fs::copy(fs::path(AMBRIG_SOURCE_DIR) / "scenarios/library/rigs/reference.toml",
           folder_ / "rig.toml");
  ASSERT_NO_FATAL_FAILURE(Follow("hidden_effect.md"));
  const auto explained = Json("explain.json");
  ASSERT_EQ(explained["verdict"], "effect");
  ASSERT_EQ(explained["adopted"].size(), 1U);
  EXPECT_EQ(explained["adopted"][0]["effect"], "cross-coupling");
  EXPECT_EQ(explained["adopted"][0]["target"], "A");
  EXPECT_LT(explained["final_ratio_validate"], 1.05);
  // The sealed answer, within four sd.
  const std::string answer = Read(folder_ / "practice.answer.toml");
  const auto at = answer.find("\"cross-coupling.stiffness\" = ");
  ASSERT_NE(at, std::string::npos);
  const auto& found = explained["adopted"][0]["parameters"]["stiffness"];
  EXPECT_NEAR(found["value"].get<double>(), std::stod(answer.substr(at + 29)),
              4 * found["sd"].get<double>());
  const auto adopted = Json("adopt.json");
  EXPECT_GT(adopted["before"]["ratio"], 4);
  EXPECT_NEAR(adopted["ratio"], 1, 0.03);
  for (const char* page : {"compare.html", "explain.html", "adopt.html"})
    EXPECT_GT(fs::file_size(folder_ / page), 1000000U) << page;
}

TEST_F(Tutorial, RealRig) {
  fs::copy(fs::path(AMBRIG_SOURCE_DIR) / "examples/mls2em", folder_, fs::copy_options::recursive);
  ASSERT_NO_FATAL_FAILURE(Follow("real_rig.md"));
  EXPECT_NEAR(Json("compare.json")["ratio"], 7.85, 0.1);
  const auto explained = Json("explain.json");
  ASSERT_EQ(explained["verdict"], "effect");
  ASSERT_FALSE(explained["adopted"].empty());
  EXPECT_EQ(explained["ranking"][0]["effect"], "freewheel-drop");
  EXPECT_LT(explained["final_ratio_validate"], 1.6);
  // The diode's drop against the authors' voltmeter, 0.561 V: an independent truth.
  ASSERT_EQ(explained["adopted"][0]["effect"], "freewheel-drop");
  const auto drop = explained["adopted"][0]["parameters"]["drop"];
  EXPECT_NEAR(drop["value"].get<double>(), 0.561, 0.04);
  EXPECT_LT(Json("adopt.json")["ratio"], 2.9);
  EXPECT_LT(Json("adopt_2.json")["ratio"], 1.8);
  // Force over the weight at the measured lift-off, at three gaps.
  const std::pair<const char*, double> shares[] = {{"05", 0.95}, {"12", 0.65}, {"19", 0.41}};
  for (const auto& [record, share] : shares) {
    std::string text = Read(folder_ / "lift" / (std::string("lift-") + record + ".csv"));
    text.pop_back();
    std::istringstream last(text.substr(text.rfind('\n') + 1));
    std::string cell;
    for (int column = 0; column < 6; ++column) std::getline(last, cell, ',');
    EXPECT_NEAR(std::stod(cell) / (0.0605 * 9.81), share, 0.02) << record;
  }
}

// Pulses and the LCR meter's table in one case: one effect for both.
void Tutorial::ExpectSolenoidsSleeve() const {
  // The page shows the record that the file holds.
  const std::string table = Read(folder_ / "table.toml");
  EXPECT_NE(Read(fs::path(AMBRIG_SOURCE_DIR) / "docs/guide/your_rig_in_an_hour.md")
                .find(table.substr(table.find('['))),
            std::string::npos);
  const auto explained = Json("solenoid.json");
  ASSERT_EQ(explained["verdict"], "effect");
  ASSERT_EQ(explained["set"].size(), 1U);
  EXPECT_EQ(explained["set"][0]["effect"], "eddy-sleeve");
  ASSERT_EQ(explained["adopted"][0]["effect"], "eddy-sleeve");
  // what is adopted is the most probable name of its own set
  for (const auto& a : explained["adopted"]) {
    if (!a.contains("set")) continue;
    EXPECT_EQ(a["set"][0]["effect"], a["effect"]);
  }
  EXPECT_GT(explained["nominal_ratio_validate"], 10);
  EXPECT_LT(explained["final_ratio_validate"], 1.2);
  // One time constant through L(100 Hz) and L(1 kHz) of the table: 591 Hz at 4.1 mm, 343 Hz at 0.
  const double cutoff = explained["adopted"][0]["parameters"]["cutoff"]["value"].get<double>();
  EXPECT_GT(cutoff, 343);
  EXPECT_LT(cutoff, 591);
  EXPECT_NEAR(cutoff, std::sqrt(343.0 * 591), 30);  // about the middle of the stroke
  EXPECT_LT(Json("solenoid_adopt.json")["ratio"],
            0.02 * Json("solenoid_compare.json")["ratio"].get<double>());
}

// From an empty folder: nothing but the logger's files.
TEST_F(Tutorial, YourRigInAnHour) {
  for (const auto& file :
       fs::directory_iterator(fs::path(AMBRIG_SOURCE_DIR) / "examples/mls2em/data"))
    fs::copy(file, folder_);
  for (const auto& file :
       fs::directory_iterator(fs::path(AMBRIG_SOURCE_DIR) / "examples/solenoid/data"))
    if (file.path().extension() != ".md" && file.path().extension() != ".txt")
      fs::copy(file, folder_);
  ASSERT_NO_FATAL_FAILURE(Follow("your_rig_in_an_hour.md"));
  ExpectSolenoidsSleeve();
  const auto explained = Json("explain.json");
  ASSERT_EQ(explained["verdict"], "effect");
  ASSERT_FALSE(explained["adopted"].empty());
  EXPECT_EQ(explained["ranking"][0]["effect"], "freewheel-drop");
  EXPECT_LT(explained["final_ratio_validate"], 1.6);
  // The voltmeter's 0.561 V.
  ASSERT_EQ(explained["adopted"][0]["effect"], "freewheel-drop");
  const auto drop = explained["adopted"][0]["parameters"]["drop"];
  EXPECT_NEAR(drop["value"].get<double>(), 0.561, 0.04);
  EXPECT_LT(Json("compare_2.json")["ratio"], 0.5 * Json("compare.json")["ratio"].get<double>());
  // Where the ball was held: 0.42 mm from the magnet in the fourth record.
  EXPECT_NE(Read(folder_ / "bench/record-4.toml").find("position = { M = [0.00957"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "bench/compare.html"));
}

// Found, described, written, fitted; the numbers that the independent simulator hid.
TEST_F(Tutorial, LawOutsideTheCatalogue) {
  if (IsLeftToNightly()) GTEST_SKIP() << "a minute of computing: AMBRIG_SLOW_TESTS=1 runs it";
  fs::copy(fs::path(AMBRIG_SOURCE_DIR) / "examples/rub", folder_, fs::copy_options::recursive);
  ASSERT_NO_FATAL_FAILURE(Follow("unknown_law.md"));
  const auto explained = Json("explain.json");
  ASSERT_EQ(explained["verdict"], "unknown");
  EXPECT_NE(explained["unexplained"]["where"].get<std::string>().find("plane B"),
            std::string::npos);
  const std::string fitted = Read(folder_ / "rig_3.toml");
  const auto is = [&](const std::string& name, double hidden, double within) {
    const auto effect = fitted.find("contact on one side"),
               at = fitted.find(name + " = { value = ", effect);
    ASSERT_NE(at, std::string::npos) << name;
    EXPECT_NEAR(std::stod(fitted.substr(at + name.size() + 13)), hidden, within) << name;
  };
  is("a", -2.1, 0.15);
  is("k", 6e5, 2e5);
  is("gap", -4e-6, 3e-6);
  is("lobe", 8e-6, 4e-6);
  is("mu", 0.3, 0.2);
  is("period", 0.11, 0.004);
  const double before = explained["base_ratio_validate"],
               after = Json("adopt.json")["ladder"].back()["ratio_validate"];
  EXPECT_LT(after, 0.75 * before);
}

// PID, LQG and H-infinity on the flexible rig: what the page says of each holds, and its point
// again is the same.
TEST_F(Tutorial, DesignStudy) {
  if (IsLeftToNightly()) GTEST_SKIP() << "a minute of computing: AMBRIG_SLOW_TESTS=1 runs it";
  fs::create_directories(folder_ / "examples");
  for (const char* folder : {"design_tum", "tum_mbtr"})
    fs::copy(fs::path(AMBRIG_SOURCE_DIR) / "examples" / folder, folder_ / "examples" / folder,
             fs::copy_options::recursive);
  ASSERT_NO_FATAL_FAILURE(Follow("design.md"));
  // One number at a time: without speeds or uncertainty the loop is unstable, without the disk's
  // weight its mode rings.
  const auto why = Json("out/why/study.json")["points"];
  const auto point = [&](const char* candidate, const char* path, double value) {
    for (const auto& p : why)
      if (p["candidate"] == candidate && p["variables"][path] == value) return p;
    ADD_FAILURE() << candidate << " without " << value;
    return nlohmann::json();
  };
  EXPECT_TRUE(point("range of speeds designed for", "controller.speeds[1]",
                    1.0)["figures"]["peak_sensitivity"]
                  .is_null());
  EXPECT_TRUE(point("uncertainty of the modes", "controller.modes.uncertainty",
                    0.0)["figures"]["peak_sensitivity"]
                  .is_null());
  EXPECT_LT(point("uncertainty of the modes", "controller.modes.uncertainty",
                  0.03)["figures"]["peak_sensitivity"],
            3.0);
  const auto ringing = point("weight of the disk", "controller.plane[0].position_weight",
                             1.0)["figures"]["amplification"],
             held = point("weight of the disk", "controller.plane[0].position_weight",
                          1.0e-5)["figures"]["amplification"];
  EXPECT_GT(ringing.get<double>(), 5 * held.get<double>());
  // The study: all three hold zone A with the coil's fault in the run; only the syntheses damp the
  // first bending mode.
  const auto study = Json("out/study/study.json");
  for (const char* candidate : {"PID", "LQG", "H-infinity"}) {
    const auto& shown = study["points"][study["shown"][candidate].get<std::size_t>()];
    EXPECT_TRUE(shown["front"].get<bool>()) << candidate;
    EXPECT_LT(shown["figures"]["peak_sensitivity"], 3.0) << candidate;
    EXPECT_EQ(shown["figures"]["run-up: touchdown"], 0) << candidate;
    const double amplification = shown["figures"]["amplification"];
    if (std::string(candidate) == "PID") {
      EXPECT_GT(amplification, 20);
    } else {
      EXPECT_LT(amplification, 15) << candidate;
    }
  }
  EXPECT_GT(fs::file_size(folder_ / "out/study/report.html"), 1000000U);
}

}  // namespace
