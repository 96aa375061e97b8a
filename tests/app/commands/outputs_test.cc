// Before a command's work starts: what may be written, what a run will cost, and what its page is
// made of.
#include "app/commands/outputs.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "app/commands/run_size.h"
#include "app/pages/run_report_data.h"
#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "tests/actuators/magnetics/reference_lanes.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using testing::ErrorText;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WriteBytes;

class Outputs : public ::testing::Test {
 protected:
  bool Made(const std::string& name, const std::string& text) const {
    WriteBytes(folder_.File(name), text);
    return MadeByAmbrig(folder_.File(name));
  }
  TemporaryFolder folder_;
};

TEST_F(Outputs, CarryAMark) {
  EXPECT_TRUE(Made("a.json", MarkedJson({{"x", 1}})));
  EXPECT_FALSE(Made("b.json", "{\"x\": 1}"));
  EXPECT_TRUE(Made("c.json", MarkedJson(nlohmann::ordered_json::array({{{"x", 1}}, {{"x", 2}}}))));
  EXPECT_FALSE(Made("a.html", "<html>ambrig</html>"));
  EXPECT_TRUE(Made("b.html", "<meta name=\"generator\" content=\"ambrig\">"));
  EXPECT_TRUE(Made("rig.toml", "# made by ambrig adopt\n"));
  EXPECT_FALSE(Made("own.toml", "name = \"mine\"\n"));
  EXPECT_TRUE(Made("empty.json", ""));  // nothing is lost
  EXPECT_FALSE(Made("lonely.csv", "t,x\n0,1\n"));
  EXPECT_TRUE(Made("a.csv", "t,x\n0,1\n"));  // beside a.json of ours
}

// Commands take speeds in rpm, Hz or rad/s; one that names its unit is the same for all.
TEST(SpeedIn, AUnitIsConvertedAndABareNumberStays) {
  EXPECT_EQ(SpeedIn("3000rpm", "Hz"), "50");
  EXPECT_EQ(SpeedIn("50 Hz", "rpm"), "3000");
  EXPECT_NEAR(std::stod(SpeedIn("50Hz", "rad/s")), 314.159265358979, 1e-10);
  EXPECT_EQ(SpeedIn("3000", "Hz"), "3000");
  EXPECT_EQ(SpeedIn("fast", "Hz"), "fast");
  EXPECT_THAT(ErrorText<InputError>([] { SpeedIn("3 mm", "Hz"); }), HasSubstr("mm"));
}

TEST_F(Outputs, TheMarkIsTheFirstKey) {
  const auto json = nlohmann::ordered_json::parse(MarkedJson({{"x", 1}, {"y", 2}}));
  EXPECT_EQ(json.begin().key(), "made_by");
  EXPECT_EQ(json["y"], 2);
}

TEST_F(Outputs, OfOthersAreNotOverwrittenUnlessForced) {
  WriteBytes(folder_.File("notes.json"), "{}");
  const std::vector<std::string> files = {folder_.File("new.json"), folder_.File("notes.json")};
  EXPECT_THAT(ErrorText<InputError>([&] { RefuseOverwriting(files, false); }),
              HasSubstr("notes.json exists and is not an output of ambrig"));
  EXPECT_NO_THROW(RefuseOverwriting(files, true));
  EXPECT_NO_THROW(RefuseOverwriting({folder_.File("new.json")}, false));
}

// What somebody changed is his own, whatever mark it carries; what went into another file takes its
// hash along not.
TEST_F(Outputs, ChangedByHandAreNotOverwrittenUnlessForced) {
  const std::string file = folder_.File("rig.toml");
  WriteMarkedText(file, "adopt", "name = \"a\"\n");
  const std::string written = ReadFile(file);
  EXPECT_TRUE(written.starts_with("# made by ambrig adopt\nname = \"a\"\n# hash of"));
  EXPECT_NO_THROW(RefuseOverwriting({file}, false));
  WriteMarkedText(file, "refine", written + "x = 1\n");
  EXPECT_NO_THROW(RefuseOverwriting({file}, false));
  EXPECT_EQ(ReadFile(file).find("hash"), ReadFile(file).rfind("hash"));
  WriteBytes(file, written + "# a note\n");
  EXPECT_THAT(ErrorText<InputError>([&] { RefuseOverwriting({file}, false); }),
              HasSubstr("rig.toml was changed since ambrig wrote it"));
  EXPECT_NO_THROW(RefuseOverwriting({file}, true));
  WriteBytes(file, written.substr(0, written.rfind("# hash")) + "mass = 9.9\n");
  EXPECT_THAT(ErrorText<InputError>([&] { RefuseOverwriting({file}, false); }),
              HasSubstr("rig.toml was changed since ambrig wrote it"));
}

// The same file under another name is the same file.
TEST_F(Outputs, DoNotReplaceWhatIsRead) {
  WriteBytes(folder_.File("in.toml"), "x = 1\n");
  std::filesystem::create_symlink(folder_.File("in.toml"), folder_.File("link.toml"));
  EXPECT_THAT(ErrorText<InputError>([&] {
                RefuseInputAsOutput(folder_.File("link.toml"), {folder_.File("in.toml")});
              }),
              HasSubstr("is read by this command"));
  EXPECT_NO_THROW(RefuseInputAsOutput(folder_.File("out.toml"), {folder_.File("in.toml")}));
  EXPECT_NO_THROW(RefuseInputAsOutput("", {folder_.File("in.toml")}));
}

TEST_F(Outputs, FoldersAreMadeOrRefused) {
  PrepareFolder(folder_.File("a/b/c"));
  EXPECT_TRUE(std::filesystem::is_directory(folder_.File("a/b/c")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.File("a/b/c")));  // the trial left nothing
  WriteBytes(folder_.File("file"), "");
  EXPECT_THAT(ErrorText<InputError>([&] { PrepareFolder(folder_.File("file")); }),
              HasSubstr("cannot write"));
  EXPECT_THAT(ErrorText<InputError>([&] { PrepareFolder("/proc/nowhere"); }),
              HasSubstr("cannot write /proc/nowhere"));
}

TEST(NumberOptions, TakeNumbersInsideTheirRange) {
  const CLI::Validator v = NumberIn(0, 10, "Hz");
  const auto verdict = [&](std::string text) { return v(text); };
  EXPECT_EQ(verdict("0"), "");
  EXPECT_EQ(verdict("9.5e0"), "");
  EXPECT_EQ(verdict("11"), "11, allowed: 0 to 10 Hz");
  for (const char* bad : {"-1", "nan", "3x", "", "ten"}) EXPECT_NE(verdict(bad), "") << bad;
}

Scenario Long(double duration) {
  Scenario s;
  s.file = "s.toml";
  s.duration = duration;
  s.record_rate = 12500;
  return s;
}

// Two copies of rows x columns doubles; columns: omega, theta, bus, two per axis, three per coil.
TEST(RunSize, MemoryAndTimeAreKnownBefore) {
  const RigParameters& rig = ReferenceLanesRig();
  EXPECT_EQ(RecordColumns(rig, false), 3u + 2 * 5 + 3 * 20);
  EXPECT_DOUBLE_EQ(RunMemory(rig, Long(2), 0), 2 * 25001 * 73 * 8.0);
  EXPECT_DOUBLE_EQ(RunMemory(rig, Long(2), 25000), 2 * 50001 * 73 * 8.0);
  // Six times real time, with the quarter of a second in which the loop settles.
  EXPECT_NEAR(RunSeconds(rig, Long(60)), 60.25 / 6, 1e-9);
  EXPECT_NEAR(RunSeconds(rig, Long(60), Fidelity::kReference), 602.5, 1e-7);
  Scenario resting = Long(60);
  resting.start = StartState::kResting;
  EXPECT_NEAR(RunSeconds(rig, resting), 10, 1e-9);
  EXPECT_EQ(DurationText(40), "40 s");
  EXPECT_EQ(DurationText(720), "12 min");
  EXPECT_EQ(DurationText(3.5 * 3600), "3.5 h");
  EXPECT_GT(FreeMemory(), 1e6);
}

TEST(RunSize, WhatIsTooLongOrTooLargeIsRefused) {
  const RigParameters& rig = ReferenceLanesRig();
  EXPECT_NO_THROW(CheckRunSize(rig, Long(10), 0, false));
  EXPECT_THAT(ErrorText<InputError>([&] { CheckRunSize(rig, Long(30000), 1, false); }),
              HasSubstr("would take about 83 min, allowed: 60 min unless --long is given"));
  EXPECT_NO_THROW(CheckRunSize(rig, Long(30000), 1, true));
  // Half an hour of the rig is short, unless every period is integrated with error control.
  EXPECT_NO_THROW(CheckRunSize(rig, Long(1800), 1, false));
  EXPECT_THROW(CheckRunSize(rig, Long(1800), 1, false, Fidelity::kReference), InputError);
  EXPECT_THAT(ErrorText<InputError>([&] { CheckRunSize(rig, Long(90000), 450e3, true); }),
              HasSubstr("the record would need"));
  EXPECT_NO_THROW(CheckRecordRate(rig, 5000, "--rate"));
  EXPECT_THAT(ErrorText<InputError>([&] { CheckRecordRate(rig, 7000, "--rate"); }),
              HasSubstr("--rate = 7000 Hz, allowed: the switching frequency 25000 Hz"));
}

class RunReportDataTest : public ::testing::Test {
 protected:
  RunReportDataTest() {
    WriteBytes(folder_.File("rig.toml"), "rig text");
    WriteBytes(folder_.File("s.toml"), "scenario text");
    rig_.file = folder_.File("rig.toml");
    scenario_.file = folder_.File("s.toml");
    scenario_.name = "open";
    FaultSpec f;
    f.time = 0.1;
    f.target = "A.coil3";
    f.kind = "open";
    scenario_.faults = {f};
    result_.record.rate = 100;
    result_.record.channels = {
        {"A.r.x", "m", {1, 2}}, {"A.i3", "A", {3, 4}}, {"omega", "rad/s", {kPi / 30, 0}}};
    RunEvent e;
    e.t = 0.1002;
    e.kind = "classified";
    e.target = "A.coil3";
    e.fault_class = "partial-short";
    e.fraction = 0.25;
    result_.events = {e};
    FluxSnapshot before, after;
    before.bearing = after.bearing = "A";
    before.label = "before the fault";
    before.t = 0.1;
    after.label = "fault-tolerant";
    after.t = 0.12;
    result_.snapshots = {before, after};
  }
  RunReportData Data(const std::vector<ExpectResult>& expect = {}) const {
    return MakeRunReportData(rig_, scenario_, result_, expect, "switching");
  }
  TemporaryFolder folder_;
  RigParameters rig_ = ReferenceLanesRig();
  Scenario scenario_;
  RunResult result_;
};

TEST_F(RunReportDataTest, TakesChannelsEventsAndFiles) {
  const RunReportData d = Data();
  ASSERT_EQ(d.bearings.size(), 2u);  // the radial ones
  EXPECT_EQ(d.bearings[0].x, (std::vector<double>{1, 2}));
  EXPECT_EQ(d.bearings[0].currents[2], (std::vector<double>{3, 4}));
  EXPECT_TRUE(d.bearings[0].currents[0].empty());  // not recorded
  EXPECT_EQ(d.bearings[0].clearance, 2e-4);
  EXPECT_NEAR(d.bearings[0].pole_angles[1] - d.bearings[0].pole_angles[0], kPi / 4, 1e-12);
  EXPECT_NEAR(d.channels[0].samples[0], 1, 1e-12);  // rpm
  EXPECT_EQ(d.events[0].target, "A3");
  EXPECT_EQ(d.events[0].text, "partial-short, 25 % of the turns");
  EXPECT_EQ(d.scenario_toml, "scenario text");
  EXPECT_EQ(d.rig_toml, "rig text");
  EXPECT_TRUE(d.snapshots[0].failed.empty());
  EXPECT_EQ(d.snapshots[1].failed, std::vector<int>{3});
}

TEST_F(RunReportDataTest, TheVerdictFollowsContactAndExpectations) {
  EXPECT_EQ(Data().verdict, Verdict::kOk);
  EXPECT_THAT(Data().verdict_text, HasSubstr("stayed up"));
  result_.touchdown = true;
  EXPECT_EQ(Data().verdict, Verdict::kWarn);
  EXPECT_EQ(Data({{"touchdown", "false", "true", false}}).verdict, Verdict::kFail);
  EXPECT_THAT(Data({{"drop", "false", "false", true}}).verdict_text,
              HasSubstr("Every expectation is met."));
  result_.drop = true;
  EXPECT_EQ(Data().verdict, Verdict::kFail);
  EXPECT_EQ(Data().verdict_text, "The rotor dropped.");
}

}  // namespace
}  // namespace ambrig
