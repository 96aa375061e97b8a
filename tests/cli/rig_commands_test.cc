// Commands that answer questions about a rig without running it: redistribute, rotor convert.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class RigCommands : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
  }
  Json JsonFile(const std::string& name) const { return Json::parse(ReadText(folder_ / name)); }
};

// W of a failure set: the dead coil has no current, the force is k c0 v. With Maxwell's force at
// the centre, coils at angles a_j give f = (k/8) sum i_j^2 (cos a_j, sin a_j) per c0 and pattern;
// here only what holds for any exact W is asked: no current in failed coils, healthy W is (1, cos,
// sin).
TEST_F(RigCommands, RedistributeSilencesTheFailedCoils) {
  const Outcome o = Ambrig("redistribute rig.toml --failed '1;1,2' --json w.json --html w.html");
  ASSERT_EQ(o.exit, 0) << o.text;
  const Json j = JsonFile("w.json");
  EXPECT_EQ(j["bearing"], "A");
  ASSERT_EQ(j["sets"].size(), 2u);
  EXPECT_THAT(j["sets"][1]["failed"], ElementsAre(1, 2));
  for (const Json& s : j["sets"]) {
    ASSERT_EQ(s["W"].size(), 8u);
    for (const Json& coil : s["failed"])
      for (const Json& w : s["W"][coil.get<std::size_t>() - 1]) EXPECT_EQ(w, 0);
    EXPECT_EQ(s["class"], "exact");
    EXPECT_LT(s["residual"].get<double>(), 1e-6);
    EXPECT_GT(s["capacity"]["flux"].get<double>(), 0);
    EXPECT_LE(s["capacity"]["current"].get<double>(), 1 + 1e-9);
  }
  EXPECT_GT(j["sets"][0]["capacity"]["flux"], j["sets"][1]["capacity"]["flux"]);
  EXPECT_THAT(o.text, HasSubstr("{1,2}"));
  const std::string words = testing::Words(ReadText(folder_ / "w.html"));
  EXPECT_THAT(words, HasSubstr("\n{1}\nW, exact\nyes\n"));
  EXPECT_THAT(words, HasSubstr("\n{1,2}\nW, exact\nyes\n"));
}

// The force of an exact W, computed here from the poles: quadratic in (c0, v), its linear part k c0
// v, no bias force, no force along v_x from v_y.
TEST_F(RigCommands, AnExactDistributionGivesTheForceThatItPromises) {
  ASSERT_EQ(Ambrig("redistribute rig.toml --failed 3 --json w.json").exit, 0);
  const Json j = JsonFile("w.json");
  const double k = j["k"], c0 = j["c0"], mu0 = 4e-7 * std::acos(-1.0);
  const double N = 50, A = 2.0372e-4, g = 4e-4, degree = std::acos(-1.0) / 180;
  const auto force = [&](double vx, double vy) {
    std::array<double, 8> mmf{};
    double mean = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      const Json& w = j["sets"][0]["W"][c];
      const double i = w[0].get<double>() * c0 + w[1].get<double>() * vx + w[2].get<double>() * vy;
      mmf[c] = N * (c % 2 == 0 ? i : -i);
      mean += mmf[c] / 8;  // equal gaps: the rotor's potential
    }
    std::array<double, 2> f{};
    for (std::size_t c = 0; c < 8; ++c) {
      const double phi = mu0 * A / g * (mmf[c] - mean), pull = phi * phi / (2 * mu0 * A);
      const double a = (22.5 + 45.0 * static_cast<double>(c)) * degree;
      f[0] += pull * std::cos(a);
      f[1] += pull * std::sin(a);
    }
    return f;
  };
  for (const auto& [vx, vy] : {std::pair{0.0, 0.0}, {0.4, 0.0}, {0.0, -0.3}, {0.2, 0.5}}) {
    EXPECT_NEAR(force(vx, vy)[0], k * c0 * vx, 2e-3);
    EXPECT_NEAR(force(vx, vy)[1], k * c0 * vy, 2e-3);
  }
}

TEST_F(RigCommands, RedistributeRefusesWhatIsNoSet) {
  const auto complaint = [&](const std::string& arguments) {
    const Outcome o = Ambrig("redistribute rig.toml " + arguments);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    return o.text;
  };
  EXPECT_THAT(complaint("--failed 9"), HasSubstr("unknown coil \"9\", allowed: 1 to 8"));
  EXPECT_THAT(complaint("--failed 1,1"), HasSubstr("coil 1 is named twice"));
  EXPECT_THAT(complaint("--failed 1x"), HasSubstr("unknown coil \"1x\""));
  EXPECT_THAT(complaint("--bearing Z"), HasSubstr("--bearing = Z, allowed: A, B"));
}

// To ROSS's format and back: mass, centre of mass and free bending frequencies stay.
TEST_F(RigCommands, AShaftSurvivesTheWayToRossAndBack) {
  const std::string shaft = std::string(AMBRIG_SOURCE_DIR) + "/examples/tum_mbtr/rig.toml";
  Outcome o = Ambrig("rotor convert " + shaft + " ross.json --json there.json");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("ross.json: ambrig -> ROSS"));
  o = Ambrig("rotor convert ross.json back.toml --json back.json --html back.html");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("back.toml: ROSS -> ambrig"));
  const Json there = JsonFile("there.json"), back = JsonFile("back.json");
  EXPECT_EQ(there["from"], "ambrig");
  EXPECT_EQ(back["from"], "ross");
  EXPECT_NEAR(back["mass"].get<double>(), there["mass"].get<double>(), 1e-9);
  EXPECT_NEAR(back["z_com"].get<double>(), there["z_com"].get<double>(), 1e-9);
  ASSERT_EQ(back["free_bending_hz"].size(), there["free_bending_hz"].size());
  for (std::size_t k = 0; k < back["free_bending_hz"].size(); ++k)
    EXPECT_NEAR(back["free_bending_hz"][k].get<double>(), there["free_bending_hz"][k].get<double>(),
                1e-6 * there["free_bending_hz"][k].get<double>());
  EXPECT_THAT(testing::Words(ReadText(folder_ / "back.html")), HasSubstr("free bending"));
}

TEST_F(RigCommands, AShaftThatIsNoneIsRefusedWithoutAFile) {
  const Outcome o = Ambrig("rotor convert rig.toml ross.json");
  EXPECT_EQ(o.exit, 2);
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_EQ(Files(), "rig.toml ");
}

}  // namespace
}  // namespace ambrig
