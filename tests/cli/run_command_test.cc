// ambrig run with several scenarios: all or nothing, or --keep-going; a folder is told what to do.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class RunCommand : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
    Write("a.toml", ScenarioText(""));
    Write("wrong.toml", ScenarioText("speeed = 3\n"));
    Write("b.toml", ScenarioText(""));
  }
};

TEST_F(RunCommand, OneWrongFileStopsAllBeforeTheWork) {
  const Outcome o = Ambrig("run a.toml wrong.toml b.toml --quiet --no-report");
  EXPECT_EQ(o.exit, 2);
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/a.h5"));
}

TEST_F(RunCommand, KeepGoingRunsTheOthersAndNamesEachThatIsLeftOut) {
  const Outcome o = Ambrig(
      "run wrong.toml a.toml missing.toml b.toml --quiet --no-report --keep-going --json all.json");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 2) << o.text;
  EXPECT_THAT(o.text, HasSubstr("ambrig: wrong.toml:5: "));
  EXPECT_THAT(o.text, HasSubstr("ambrig: missing.toml: "));
  for (const char* name : {"out/a.h5", "out/a.json", "out/b.h5"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/wrong.json"));
  const Json all = Json::parse(ReadText(folder_ / "all.json"));
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0]["scenario"], "wrong.toml");
  EXPECT_THAT(all[0]["error"].get<std::string>(), HasSubstr("speeed"));
  EXPECT_EQ(all[1]["name"], "t");
  // The same bits as alone.
  const std::string together = ReadText(folder_ / "out/b.h5");
  ASSERT_EQ(Ambrig("run b.toml --quiet --no-report").exit, 0);
  EXPECT_EQ(ReadText(folder_ / "out/b.h5"), together);
}

TEST_F(RunCommand, AFolderIsToldWhatRunsIt) {
  const Outcome o = Ambrig("run . --quiet");
  EXPECT_EQ(o.exit, 2);
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("a folder, allowed: scenario files"));
  EXPECT_THAT(o.text, HasSubstr("ambrig paper ."));
}

// Whoever has never heard of commissioning is told what "doubtful" means, on the screen and the
// page.
TEST_F(RunCommand, AnUncommissionedRigIsToldHowToTeachIt) {
  const Outcome o = Ambrig("run a.toml");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("model doubtful: gross faults only"));
  EXPECT_THAT(o.text, HasSubstr("has not learnt this rig"));
  EXPECT_THAT(ReadText(folder_ / "out/a.html"), HasSubstr("ambrig commission rig.toml"));
  EXPECT_THAT(ReadText(folder_ / "out/a.json"), HasSubstr("has not learnt this rig"));
}

// Rows that a run needs and the file of its command does not have.
TEST_F(RunCommand, SamplesThatEndBeforeTheRunAreNoted) {
  Write("f.csv", "t,f\n0.002,1\n0.003,1\n0.004,1\n");
  Write("short.toml", ScenarioText("[[excitation]]\ntarget = \"A.x\"\nkind = \"samples\"\nfile = "
                                   "\"f.csv\"\nchannel = \"f\"\n"));
  const Outcome o = Ambrig("run short.toml --no-report");
  EXPECT_EQ(o.exit, 0) << o.text;
  const std::string json = ReadText(folder_ / "out/short.json");
  EXPECT_THAT(json, HasSubstr("the samples of A.x begin at 0.002 s: nothing is commanded before"));
  EXPECT_THAT(json, HasSubstr("end at 0.005 s: their last value holds until 0.01 s"));
}

// No auxiliary bearing, no clearance: a dash, not 0.
// Nothing catches a ball whose magnet is lost: at the poles it has fallen, and no verdict says
// otherwise.
TEST_F(RunCommand, PastThePolesWithoutAuxiliaryBearingsIsADrop) {
  Write("fall.toml", "name = \"fall\"\nrig = \"" AMBRIG_SOURCE_DIR
                     "/scenarios/limits/one_axis.toml\"\nduration = 0.2\nrecord_rate = 1000.0\n"
                     "[[fault]]\ntime = 0.01\ntarget = \"M.coil1\"\nkind = \"open\"\n"
                     "[expect]\ndrop = false\n");
  const Outcome o = Ambrig("run fall.toml --out out --no-report");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("past the poles of M"));
  EXPECT_THAT(o.text, HasSubstr("rotor dropped"));
  EXPECT_THAT(o.text, Not(HasSubstr("rotor stayed up")));
}

TEST_F(RunCommand, WithoutAuxiliaryBearingsNoClearanceIsLeft) {
  Write("rig.toml", ReadText(AMBRIG_SOURCE_DIR "/examples/validation/mbc500.toml"));
  const Outcome o = Ambrig("run a.toml");
  ASSERT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, ::testing::ContainsRegex("clearance left +- um"));
  EXPECT_THAT(ReadText(folder_ / "out/a.html"), ::testing::Not(HasSubstr("clearance left")));
}

}  // namespace
}  // namespace ambrig
