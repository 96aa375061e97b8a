// The page and the JSON of an analysis of the reference rig: figures that hang together, every
// section, in a browser too.
#include "app/pages/analysis_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "analysis/iso14839.h"
#include "app/json/analysis_json.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "tests/app/browser.h"
#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::HasSubstr;
using ::testing::Not;

class AnalysisPage : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    AnalysisOptions o;
    o.lowest = 3000 * kRpm;
    o.highest = 6000 * kRpm;
    o.fastest = 9000 * kRpm;
    o.responses = {{"A.x.force", "A.x"}};
    analysis_ =
        std::make_unique<RigAnalysis>(Analyse(ReadRigText(ReferenceRigText(), "rig.toml"), o));
    html_ = testing::Written(
        [](const std::string& path) { WriteAnalysisReport(*analysis_, "rig.toml", path); });
    json_ = AnalysisJson(*analysis_);
  }
  static void TearDownTestSuite() { analysis_.reset(); }
  static std::unique_ptr<RigAnalysis> analysis_;
  static std::string html_;
  static nlohmann::ordered_json json_;
};
std::unique_ptr<RigAnalysis> AnalysisPage::analysis_;
std::string AnalysisPage::html_;
nlohmann::ordered_json AnalysisPage::json_;

TEST_F(AnalysisPage, HasEverySection) {
  for (const char* section :
       {"Verdict", "Bearings", "Stability margins", "Rotor dynamics",
        "Rotor without magnetic bearings", "Unbalance", "Dynamic stiffness", "Frequency responses"})
    EXPECT_EQ(CountOf(html_, std::string(">") + section + "</h"), 1u) << section;
  const std::string words = testing::Words(html_);
  EXPECT_THAT(words, HasSubstr("Analysis of reference"));
  EXPECT_THAT(words, HasSubstr("rig rig.toml, operating 3000 to 6000 rpm"));
  EXPECT_THAT(words, HasSubstr("Stable up to 9000 rpm"));
  EXPECT_THAT(words, Not(HasSubstr("Measured in the switching rig")));
  for (const char* axis : {"A.x", "A.y", "B.x", "B.y", "z"})
    EXPECT_THAT(words, HasSubstr(fmt::format("\n{}\n", axis))) << axis;
}

TEST_F(AnalysisPage, ABrowserDrawsEveryFigure) {
  if (!testing::HasBrowser()) GTEST_SKIP() << "no chromium";
  const testing::TemporaryFolder folder;
  WriteAnalysisReport(*analysis_, "rig.toml", folder.File("a.html"));
  const testing::BuiltPage built = testing::BuildInBrowser(folder.File("a.html"));
  EXPECT_EQ(built.exit_code, 0);
  EXPECT_TRUE(built.clean()) << built.console;
  EXPECT_EQ(built.figures(), CountOf(html_, "<figure id="));
  EXPECT_GE(built.figures(), 8u);
}

// The peak is the largest |S| of its curve, its zone that of the standard.
TEST_F(AnalysisPage, PeaksBelongToTheirCurves) {
  ASSERT_EQ(json_["sensitivity"].size(), 3u);  // at rest, lowest, highest
  EXPECT_EQ(json_["sensitivity"][0]["speed"], 0);
  EXPECT_NEAR(json_["sensitivity"][2]["speed"].get<double>(), 6000 * kRpm, 1e-9);
  for (const auto& s : json_["sensitivity"])
    for (const auto& a : s["axes"]) {
      const double peak = a["peak"];
      double largest = 0;
      for (std::size_t k = 0; k < s["frequency"].size(); ++k)
        if (s["frequency"][k].get<double>() <= 2000)
          largest = std::max(
              largest, std::hypot(a["S"]["re"][k].get<double>(), a["S"]["im"][k].get<double>()));
      EXPECT_NEAR(peak, largest, 0.01 * peak) << a["axis"];
      EXPECT_EQ(a["zone"], std::string(1, SensitivityZone(peak)));
      // |S| <= p keeps the gain between p/(p + 1) and p/(p - 1) at least.
      EXPECT_LE(a["gain_down"].get<double>(), peak / (peak + 1) + 1e-3) << a["axis"];
      if (a["gain_up"].is_number()) {
        EXPECT_GE(a["gain_up"].get<double>(), peak / (peak - 1) - 1e-3) << a["axis"];
      }
      EXPECT_GE(a["phase_margin"].get<double>(), 2 * std::asin(0.5 / peak) - 1e-3) << a["axis"];
    }
}

TEST_F(AnalysisPage, CapacitiesCarryTheWeight) {
  const RigParameters rig = ReadRigText(ReferenceRigText(), "rig.toml");
  double vertical = 0;
  ASSERT_EQ(json_["capacity"].size(), 5u);
  for (const auto& c : json_["capacity"]) {
    EXPECT_GT(c["k_i"].get<double>(), 0);
    EXPECT_GE(c["largest"].get<double>(), c["static"].get<double>());
    EXPECT_LE(c["static"].get<double>(),
              std::min(c["linear"].get<double>(), c["f_max"].get<double>()) + 1e-9);
    const std::string axis = c["axis"];
    if (axis.ends_with(".y")) vertical += c["weight"].get<double>();
  }
  EXPECT_NEAR(vertical, 9.81 * rig.rotor.mass, 1e-6);
}

// Speeds, whirl and damping of the Campbell diagram belong together: zeta = -re/|s|.
TEST_F(AnalysisPage, ModesAreConsistent) {
  EXPECT_EQ(json_["stable"], true);
  std::size_t modes = 0;
  for (const auto& row : json_["campbell"]) {
    EXPECT_LT(row["spectral_radius"].get<double>(), 1);
    for (const auto& m : row["modes"]) {
      ++modes;
      const double re = m["re"], im = m["im"], zeta = m["zeta"];
      EXPECT_LT(re, 0);
      EXPECT_NEAR(zeta, -re / std::hypot(re, im), 1e-9);
      EXPECT_NEAR(m["frequency"].get<double>(), std::abs(im) / (2 * kPi),
                  1e-9 + 1e-9 * std::abs(im));
    }
  }
  EXPECT_GT(modes, 10u);
  EXPECT_FALSE(json_["rotor"]["supports"].empty());
  EXPECT_EQ(json_["responses"][0]["input"], "A.x.force");
}

TEST(AnalysisPageUnstable, SaysSoInsteadOfMargins) {
  const std::string soft = Replaced(
      ReferenceRigText(), "kd = 900.0                                   # N s/m", "kd = 0.1");
  AnalysisOptions o;
  o.fastest = 100;
  const RigAnalysis a = Analyse(ReadRigText(soft, "rig.toml"), o);
  ASSERT_FALSE(a.stable());
  const std::string words = testing::Words(
      testing::Written([&](const std::string& path) { WriteAnalysisReport(a, "rig.toml", path); }));
  EXPECT_THAT(words, HasSubstr("The closed loop is unstable"));
  EXPECT_THAT(words, HasSubstr("\nunstable\n"));
  const auto json = AnalysisJson(a);
  EXPECT_EQ(json["stable"], false);
  EXPECT_TRUE(json["sensitivity"][0]["axes"][0]["peak"].is_null());
}

}  // namespace
}  // namespace ambrig
