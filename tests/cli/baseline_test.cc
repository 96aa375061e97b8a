// Records compared by `ambrig diff` and stored ones by `ambrig check --baseline`: a gain changed by
// one per cent, an event that moved, a lost channel and a NaN are found; the same run differs in no
// bit.
#include <cmath>
#include <limits>

#include "core/record/hdf5.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

class Baseline : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
    WriteScenario(0.005);
  }
  /// Coil A3 breaks at `time` [s].
  void WriteScenario(double time) const {
    Write("s.toml",
          Replaced(ScenarioText(""), "duration = 0.01", "duration = 0.02") +
              "[speed]\nprofile = [[0.0, 157.0]]\n[[fault]]\ntime = " + std::to_string(time) +
              "\ntarget = \"A.coil3\"\nkind = \"open\"\n[expect]\ndrop = false\n");
  }
  void ChangeGain() const {
    Write("rig.toml", Replaced(ReferenceRigText(), "kp = 4.0e5", "kp = 4.04e5"));
  }
  Outcome Simulate(const std::string& out) const {
    return Ambrig("run s.toml --quiet --no-report --out " + out);
  }
  Outcome Check(const std::string& more = "") const {
    return Ambrig("check s.toml --baseline base " + more);
  }
};

TEST_F(Baseline, TheSameRunDiffersInNoBit) {
  ASSERT_EQ(Simulate("a").exit, 0);
  ASSERT_EQ(Simulate("b").exit, 0);
  const Outcome o = Ambrig("diff a/s.h5 b/s.h5");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_NE(o.text.find("identical: no bit differs"), std::string::npos) << o.text;
}

// Without a baseline there is nothing to compare and no page of curves.
TEST_F(Baseline, WithoutOneNoPageIsNamed) {
  const Outcome o = Check();
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_NE(o.text.find("no such baseline"), std::string::npos) << o.text;
  EXPECT_EQ(o.text.find("difference.html"), std::string::npos) << o.text;
}

TEST_F(Baseline, GainOfOnePerCent) {
  ASSERT_EQ(Check("--accept").exit, 0);
  ASSERT_EQ(Check().exit, 0);
  ASSERT_EQ(Simulate("a").exit, 0);
  ChangeGain();
  ASSERT_EQ(Simulate("b").exit, 0);
  const Outcome diff = Ambrig("diff a/s.h5 b/s.h5 --relative 1e-4 --html d.html --json d.json");
  EXPECT_EQ(diff.exit, 1) << diff.text;
  EXPECT_NE(diff.text.find("first: "), std::string::npos) << diff.text;
  std::istringstream lines(diff.text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_NE(ReadText(folder_ / "d.html").find("largest difference"), std::string::npos);
  const Outcome check = Check("--junit c.xml");
  EXPECT_EQ(check.exit, 1) << check.text;
  EXPECT_NE(ReadText(folder_ / "c.xml").find("failures=\"1\""), std::string::npos);
  EXPECT_NE(ReadText(folder_ / "base/difference.html").find("\"before\""), std::string::npos);
  EXPECT_EQ(Check("--accept").exit, 0);
  EXPECT_EQ(Check().exit, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "base/difference.html"));  // nothing differs now
}

// A tolerance that fits no channel of any baseline is misspelt.
TEST_F(Baseline, ToleranceOfNoChannelIsRefused) {
  ASSERT_EQ(Check("--accept").exit, 0);
  Write("base/tolerances.toml", "[all]\nrelative = 1e-6\n[channel.\"A.i*\"]\nrelative = 1e-5\n");
  EXPECT_EQ(Check().exit, 0);
  Write("base/tolerances.toml", "[channel.\"Q.*\"]\nrelative = 1e-6\n");
  const Outcome o = Check();
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_NE(o.text.find("tolerances.toml: channel.\"Q.*\" fits no channel"), std::string::npos)
      << o.text;
}

TEST_F(Baseline, EventThatMovedByOnePeriod) {
  ASSERT_EQ(Check("--accept").exit, 0);
  ASSERT_EQ(Simulate("a").exit, 0);
  WriteScenario(0.00508);
  ASSERT_EQ(Simulate("b").exit, 0);
  // Even where every curve is allowed to differ.
  const Outcome diff = Ambrig("diff a/s.h5 b/s.h5 --relative 10");
  EXPECT_EQ(diff.exit, 1) << diff.text;
  EXPECT_NE(diff.text.find("event fault A.coil3 (open) moved from 5 ms to 5.08 ms"),
            std::string::npos)
      << diff.text;
  EXPECT_EQ(Ambrig("diff a/s.h5 b/s.h5 --relative 10 --events 1e-3").exit, 0);
  const Outcome check = Check();
  EXPECT_EQ(check.exit, 1) << check.text;
  EXPECT_NE(check.text.find("moved from 5 ms"), std::string::npos) << check.text;
}

TEST_F(Baseline, LostChannelAndNan) {
  ASSERT_EQ(Simulate("a").exit, 0);
  Record r = ReadHdf5((folder_ / "a/s.h5").string());
  r.channels[0].samples[30] = std::numeric_limits<double>::quiet_NaN();
  const std::string lost = r.channels[3].name;
  r.channels.erase(r.channels.begin() + 3);
  WriteHdf5(r, (folder_ / "b.h5").string());
  const Outcome o = Ambrig("diff a/s.h5 b.h5 --relative 10 --html d.html");
  EXPECT_EQ(o.exit, 1);
  for (const std::string& said : {lost + ": lost.", r.channels[0].name + ": not a number from 2.4"})
    EXPECT_NE(ReadText(folder_ / "d.html").find(said), std::string::npos) << said;
  EXPECT_NE(o.text.find(lost + ": lost"), std::string::npos) << o.text;
  EXPECT_NE(o.text.find(r.channels[0].name + ": not a number from 2.4 ms"), std::string::npos)
      << o.text;
}

// A rig without its thrust bearing has no such channels any more; a NaN stands in what was stored.
// Both are named on the screen, in the JUnit file and on the page, and a record that is as it was
// differs in no bit from its baseline's rows.
TEST_F(Baseline, CheckFindsALostChannelAndANan) {
  ASSERT_EQ(Check("--accept").exit, 0);
  const std::string rig = ReferenceRigText();
  Write("rig.toml", rig.substr(0, rig.find("[bearings.Z]")));
  const Outcome lost = Check("--junit c.xml");
  EXPECT_EQ(lost.exit, 1) << lost.text;
  EXPECT_NE(lost.text.find("Z.i1: lost"), std::string::npos) << lost.text;
  EXPECT_NE(ReadText(folder_ / "c.xml").find("Z.i1: lost"), std::string::npos);
  EXPECT_NE(ReadText(folder_ / "base/difference.html").find("Z.i1: lost."), std::string::npos);

  Write("rig.toml", rig);
  const std::string file = (folder_ / "base/s.baseline.h5").string();
  Record r = ReadHdf5(file);
  r.channels[0].samples[30] = std::numeric_limits<double>::quiet_NaN();
  WriteHdf5(r, file);
  const Outcome nan = Check("--junit c.xml");
  EXPECT_EQ(nan.exit, 1) << nan.text;
  const std::string found = r.channels[0].name + ": not a number from 2.4 ms";
  EXPECT_NE(nan.text.find(found), std::string::npos) << nan.text;
  EXPECT_NE(ReadText(folder_ / "c.xml").find(found), std::string::npos);
  EXPECT_NE(ReadText(folder_ / "base/difference.html").find(found), std::string::npos);
}

// The fault's instant moves by one switching period, 40 us, less than a row of the record: no curve
// may tell, the event does.
TEST_F(Baseline, EventThatMovedByOneSwitchingPeriod) {
  ASSERT_EQ(Check("--accept").exit, 0);
  WriteScenario(0.00504);
  const Outcome check = Check();
  EXPECT_EQ(check.exit, 1) << check.text;
  EXPECT_NE(check.text.find("event fault A.coil3 (open) moved from 5 ms to 5.04"),
            std::string::npos)
      << check.text;
  EXPECT_NE(ReadText(folder_ / "base/difference.html").find("moved from 5 ms to 5.04 ms"),
            std::string::npos);
}

TEST_F(Baseline, StoredRecordsAreSmallAndSayWhereTheyComeFrom) {
  ASSERT_EQ(Check("--accept --rows 100 --channels A.x 'A.i*'").exit, 0);
  const auto file = folder_ / "base/s.baseline.h5";
  const Record r = ReadHdf5(file.string());
  EXPECT_EQ(r.channels.size(), 9U);
  EXPECT_LE(r.rows(), 100U);
  for (const double v : r.channels[0].samples) EXPECT_EQ(v, static_cast<float>(v));
  EXPECT_EQ(r.attributes.at("rig"), ReferenceRigText());
  EXPECT_NE(r.attributes.at("events").find("A.coil3"), std::string::npos);
  EXPECT_EQ(Check().exit, 0);
  EXPECT_LT(std::filesystem::file_size(file), 60000U);
}

}  // namespace
}  // namespace ambrig
