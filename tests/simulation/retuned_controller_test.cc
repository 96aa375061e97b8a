// A controller that is designed anew for the coils that are left: what it is designed for, and how
// it takes over.
#include <gmock/gmock.h>

#include <algorithm>

#include "analysis/linear/control_plant.h"
#include "analysis/linear/operating_point.h"
#include "faulttolerance/redistribution/redistribution_setup.h"
#include "faulttolerance/redistribution/redistribution_table.h"
#include "rig/rig_file.h"
#include "simulation/sampled/controller_setup.h"
#include "simulation/sampled/designed_maps.h"
#include "simulation/simulate.h"
#include "tests/core/temporary_folder.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

const std::string kRetunedFolder = AMBRIG_SOURCE_DIR "/scenarios/campaigns/retuned/";

const RigParameters& RetunedRig() {
  static const RigParameters rig = ReadRig(kRetunedFolder + "rig.toml");
  return rig;
}

/// Bearing A after these coils (from 1) have kept a share of their turns.
ReplaceMap FailedAtA(const std::vector<int>& coils, double turns) {
  const NominalRig nominal(RetunedRig());
  const RedistributionTable table(RedistributionProblemOf(nominal, nominal->bearings[0]),
                                  ::testing::TempDir() + "ambrig_fdd_tables");
  ReplaceMap change;
  for (const int coil : coils) change.turns_left[coil - 1] = turns;
  const OperatingPoint healthy(TrueRig::AsDrawn(nominal), nominal);
  change.map = healthy.control()[0].map;
  change.map.W = table.Lookup(change.turns_left).W;
  return change;
}

/// Stiffness that the linear plant of a synthesis has at A [N/m]; nothing weighs on the rotor.
Eigen::Matrix2d StiffnessAtA(const ReplaceMap& change) {
  RigParameters floating = RetunedRig();
  floating.gravity = {0, 0, 0};
  const NominalRig nominal(floating);
  std::vector<CurrentMap> maps;
  TakeIntoDesign(nominal, change, &maps);
  EXPECT_EQ(maps.size(), 3U);
  return OperatingPoint(TrueRig::AsDrawn(nominal), nominal, maps).bearings[0].NegativeStiffness();
}

// The stiffness that redistribution knows of its W, by its own closed form.
TEST(RetunedController, IsDesignedForTheStiffnessThatTheCoilsLeave) {
  const NominalRig nominal(RetunedRig());
  const RedistributionTable table(RedistributionProblemOf(nominal, nominal->bearings[0]),
                                  ::testing::TempDir() + "ambrig_fdd_tables");
  for (const std::vector<int>& coils : {std::vector<int>{3}, {1, 2}, {2, 4, 6}}) {
    const ReplaceMap change = FailedAtA(coils, 0);
    const Eigen::Matrix2d wanted = table.Lookup(change.turns_left).stiffness,
                          found = StiffnessAtA(change);
    EXPECT_LT((found - wanted).norm(), 0.02 * wanted.norm()) << coils.size() << "\n" << found;
  }
  // Where the map asks the coils for other currents the stiffness is another one.
  const Eigen::Matrix2d healthy = StiffnessAtA(FailedAtA({}, 0));
  EXPECT_GT((StiffnessAtA(FailedAtA({1, 2}, 0)) - healthy).norm(), 0.1 * healthy.norm());
}

// Half of the turns, twice the current: the same ampere-turns, the same stiffness.
TEST(RetunedController, ShortedTurnsCountAsAmpereTurns) {
  const ReplaceMap change = FailedAtA({3}, 0.5);
  const NominalRig nominal(RetunedRig());
  std::vector<CurrentMap> maps;
  TakeIntoDesign(nominal, change, &maps);
  EXPECT_NEAR(maps[0].W(2, 0), 0.5 * change.map.W(2, 0), 1e-12);
  const RedistributionTable table(RedistributionProblemOf(nominal, nominal->bearings[0]),
                                  ::testing::TempDir() + "ambrig_fdd_tables");
  const Eigen::Matrix2d wanted = table.Lookup(change.turns_left).stiffness;
  EXPECT_LT((StiffnessAtA(change) - wanted).norm(), 0.02 * wanted.norm());
}

TEST(RetunedController, IsStableWithTheBearingThatItIsDesignedFor) {
  const NominalRig nominal(RetunedRig());
  std::vector<CurrentMap> maps;
  TakeIntoDesign(nominal, FailedAtA({1, 2}, 0), &maps);
  const std::vector<std::size_t> radial{0, 1, 2, 3};
  const StateSpace plant = MakeControlPlant(RetunedRig(), radial, 0, nullptr, {}, maps).FromForce();
  for (const ControllerParameters& c : nominal->other_controllers) {
    const auto anew = MakeCentralController(nominal, c, nullptr, maps),
               before = MakeCentralController(nominal, c);
    EXPECT_LT(SpectralRadius(LoopMatrix(plant, anew->Linear(0))), 1) << c.name;
    EXPECT_GT((anew->Linear(0).B - before->Linear(0).B).norm() +
                  (anew->Linear(0).C - before->Linear(0).C).norm(),
              0)
        << c.name;
  }
}

RunResult OpenedAtA(const std::string& keys) {
  std::string text = "name = \"t\"\nduration = 0.06\n" + keys;
  for (const char* coil : {"1", "2"})
    text +=
        std::string("[[fault]]\ntime = 0.02\ntarget = \"A.coil") + coil + "\"\nkind = \"open\"\n";
  return Simulate(RetunedRig(), ReadScenarioText(text, kRetunedFolder + "t.toml", RetunedRig()),
                  {});
}

std::vector<double> InstantsOf(const RunResult& r, const std::string& kind) {
  std::vector<double> out;
  for (const RunEvent& e : r.events)
    if (e.kind == kind) out.push_back(e.t);
  return out;
}

// In the period of every redistribution, without a bump.
TEST(RetunedController, TakesOverWithTheNewCurrents) {
  const RunResult fixed = OpenedAtA("");
  EXPECT_TRUE(InstantsOf(fixed, "retuned").empty());
  for (const char* name : {"lqg", "h-infinity"}) {
    const RunResult r = OpenedAtA(std::string("retuned_controller = \"") + name + "\"\n");
    ASSERT_FALSE(InstantsOf(r, "redistributed").empty());
    EXPECT_EQ(InstantsOf(r, "retuned"), InstantsOf(r, "redistributed")) << name;
    EXPECT_FALSE(r.touchdown);
    EXPECT_LT(r.metrics.max_orbit.at("A"), 1.5 * fixed.metrics.max_orbit.at("A")) << name;
  }
}

// The second fault of two: the controller of the first gives way to another one.
TEST(RetunedController, IsDesignedAnewAfterEveryFault) {
  const RunResult r = Simulate(
      RetunedRig(),
      ReadScenarioText(
          "name = \"t\"\nduration = 0.07\nretuned_controller = \"lqg\"\n[[fault]]\ntime = 0.02\n"
          "target = \"A.coil3\"\nkind = \"open\"\n[[fault]]\ntime = 0.04\ntarget = "
          "\"A.coil6\"\nkind = \"open\"\n",
          kRetunedFolder + "t.toml", RetunedRig()),
      {});
  EXPECT_EQ(InstantsOf(r, "retuned").size(), 2U);
  EXPECT_FALSE(r.touchdown);
}

TEST(RetunedController, HasToBeOneThatASynthesisMakes) {
  const auto refusal = [](const RigParameters& rig, const std::string& name) {
    return testing::ErrorText<InputError>([&] {
      ReadScenarioText("name = \"t\"\nduration = 0.1\nretuned_controller = \"" + name + "\"\n",
                       kRetunedFolder + "t.toml", rig);
    });
  };
  EXPECT_THAT(refusal(RetunedRig(), "main"), HasSubstr("t.toml:3"));
  EXPECT_THAT(refusal(RetunedRig(), "main"), HasSubstr("lqg, h-infinity): h-infinity, lqg"));
  EXPECT_THAT(refusal(RigWith("kind = \"pid\"\n" + kPidGains), "main"), HasSubstr("it has none"));
}

}  // namespace
}  // namespace ambrig
