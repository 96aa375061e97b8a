// What a commissioning promises: shorts that leave the learnt bands, in closed form, and how it is
// told.
#include "app/pages/commission_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "fdd/detectors/detection_feed.h"
#include "rig/rig_file.h"
#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kT = 4e-5;

CommissionedBearing Quiet() {
  CommissionedBearing b;
  b.name = "A";
  b.learnt = true;
  b.grade = 1.1;
  b.rows = 5000;
  for (auto& window : b.largest)
    for (double& v : window.v) v = 0;
  return b;
}

/// The excess of a bypassed share of the turns.
double Excess(double s) { return 0.9 * (1 / ((1 - s) * (1 - s)) - 1); }

// Without scatter the least band is the lowest floor, of the longest window.
TEST(Detectable, OfAQuietBearingIsTheLowestFloor) {
  const Detectable d = DetectableIn(Quiet(), 0, kT);
  EXPECT_NEAR(Excess(d.smallest_short), kExcessFloor[kExcessWindows - 1], 1e-9);
  EXPECT_NEAR(d.smallest_delay, kT * (kExcessWindow[kExcessWindows - 1] + 2), 1e-12);
  EXPECT_GT(d.open_delay, 0);
  EXPECT_LT(d.tenth_delay, d.smallest_delay);
  EXPECT_GT(d.tenth_delay, 0);
}

// Scatter of healthy running raises the smallest short and the delay of a given one.
TEST(Detectable, ScatterCostsSizeAndTime) {
  CommissionedBearing b = Quiet();
  Detectable before = DetectableIn(b, 2, kT);
  for (const double scatter : {0.05, 0.1, 0.15}) {
    for (auto& window : b.largest) window.v[2] = scatter;
    const Detectable d = DetectableIn(b, 2, kT);
    EXPECT_GT(d.smallest_short, before.smallest_short);
    EXPECT_TRUE(d.tenth_delay < 0 || d.tenth_delay >= before.tenth_delay);
    before = d;
  }
  for (auto& window : b.largest) window.v[2] = 1;
  EXPECT_LT(DetectableIn(b, 2, kT).tenth_delay, 0);  // a tenth of the turns stays inside
  EXPECT_GT(DetectableIn(b, 3, kT).tenth_delay, 0);  // the other coils are as before
}

class CommissionPage : public ::testing::Test {
 protected:
  CommissionPage() {
    const LinkageModel m = LinkageModelOf(*rig_.Find("A"));
    CommissionedBearing b = NominalBearing("A", m);
    b.learnt = true;
    b.grade = 1.25;
    b.rows = 5000;
    for (auto& window : b.largest)
      for (double& v : window.v) v = 0.01;
    result_.model.bearings = {b};
    ExcessScatter s;
    s.quantity = "displacement";
    s.unit = "m";
    s.bins = {{0, 1e-5, 0.002, 0.006, 777}};
    result_.scatter = {{s}};
  }
  RigParameters rig_ = ReadRigText(ReferenceRigText(), "rig.toml");
  CommissioningResult result_;
};

TEST_F(CommissionPage, TellsEveryCoil) {
  const std::string words = testing::Words(testing::Written(
      [&](const std::string& path) { WriteCommissionReport(rig_, result_, path); }));
  EXPECT_THAT(words, HasSubstr("Bearing A\n"));
  EXPECT_THAT(words, HasSubstr("Grade 1.25 over 5000 rows; the model expresses this bearing"));
  EXPECT_THAT(words, HasSubstr("displacement [µm]"));
  EXPECT_THAT(words, HasSubstr("\n0 to 10\n0.0020\n0.0060\n777\n"));
  for (const char* word : {"Grade", "Excess", "Ripple inductance", "Smallest short"})
    EXPECT_THAT(words, HasSubstr(std::string(word) + "\n: ")) << word;
  EXPECT_THAT(words, HasSubstr("\n0.0100\n"));
  const std::string text = CommissionText(rig_, result_);
  for (int j = 1; j <= 8; ++j) EXPECT_THAT(text, HasSubstr(fmt::format("A.coil{} ", j)));
}

// One number in all three, and the slope is bus voltage over inductance.
TEST_F(CommissionPage, JsonAgreesWithTheFormulas) {
  const auto j = CommissionJson(rig_, result_);
  EXPECT_EQ(j["rig"], "reference");
  const auto& coil = j["bearings"][0]["coils"][4];
  EXPECT_EQ(coil["coil"], 5);
  const double L = coil["ripple_inductance"];
  EXPECT_GT(L, rig_.Find("A")->radial.leakage_inductance);
  EXPECT_NEAR(coil["slope"].get<double>(), rig_.amplifier.bus_voltage / L, 1e-6);
  EXPECT_NEAR(coil["time_constant"].get<double>(), L / coil["resistance"].get<double>(), 1e-12);
  EXPECT_EQ(coil["largest_excess"], 0.01);
  EXPECT_EQ(j["bearings"][0]["usable"], true);
  EXPECT_EQ(j["bearings"][0]["scatter"][0]["bins"][0]["values"], 777);
}

TEST_F(CommissionPage, ABadModelIsRefused) {
  result_.model.bearings[0].grade = 7;
  const std::string words = testing::Words(testing::Written(
      [&](const std::string& path) { WriteCommissionReport(rig_, result_, path); }));
  EXPECT_THAT(words, HasSubstr("refused: the model does not express this bearing"));
  EXPECT_THAT(CommissionText(rig_, result_), HasSubstr("bearing A: grade 7.00 is above 2.5"));
  EXPECT_EQ(CommissionJson(rig_, result_)["bearings"][0]["usable"], false);
  result_.model.bearings[0].grade = 1;
  EXPECT_THAT(CommissionText(rig_, result_), Not(HasSubstr("is above")));
}

}  // namespace
}  // namespace ambrig
