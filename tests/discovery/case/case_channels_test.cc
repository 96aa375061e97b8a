// Columns of a logger's file as channels of the rig: names, units, gains, delays, and what is left
// out.
#include "discovery/case/case_channels.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "core/base/errors.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

class CaseChannels : public ::testing::Test {
 protected:
  CaseChannels() {
    raw_.rate = 1000;
    raw_.start = 0.25;
    raw_.channels = {{"A.x", "um", {1, 2, 3, 4}},
                     {"probe 7", "", {10, 20, 30, 40}},
                     {"A.i1", "mA", {500, 600, 700, 800}},
                     {"room temperature", "K", {293, 293, 293, 293}}};
  }
  /// The record that a [[record]] with these [record.channels] makes of the file.
  Record Mapped(const std::string& channels) {
    const TomlTable root = TomlTable::FromText(
        "[[record]]\ndata = \"log.csv\"\n[record.channels]\n" + channels, "case.toml");
    table_ = root.Tables("record")[0];
    return MapChannels(raw_, ReadMapping(*table_, known_), known_, *table_, case_, sources_);
  }
  std::string Message(const std::string& channels) {
    try {
      Mapped(channels);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no mistake";
  }

  const std::map<std::string, std::string> known_ = KnownChannels(ReferenceLanesRig());
  std::optional<TomlTable> table_;
  std::map<std::string, ColumnSource> sources_;
  Record raw_;
  Case case_;
};

TEST_F(CaseChannels, TheRigsChannelsHaveTheirUnits) {
  EXPECT_EQ(known_.at("A.x"), "m");
  EXPECT_EQ(known_.at("Z.i4"), "A");
  EXPECT_EQ(known_.at("bus"), "V");
  EXPECT_EQ(known_.at("omega"), "rad/s");
  EXPECT_FALSE(known_.contains("C.x"));
}

TEST_F(CaseChannels, ColumnsOfTheRigsNamesComeWithoutBeingNamed) {
  const Record r = Mapped("");
  EXPECT_EQ(r.rate, 1000);
  EXPECT_EQ(r.start, 0.25);
  ASSERT_EQ(r.channels.size(), 2u);
  EXPECT_NEAR(r.Find("A.x")->samples[3], 4e-6, 1e-18);
  EXPECT_EQ(r.Find("A.x")->unit, "m");
  EXPECT_NEAR(r.Find("A.i1")->samples[0], 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(sources_.at("A.x").factor, 1e-6);
  ASSERT_EQ(case_.notes.size(), 1u);
  EXPECT_EQ(case_.notes[0],
            "log.csv: columns without a rig channel, left out: probe 7, room temperature");
}

TEST_F(CaseChannels, ANamedColumnHasItsUnitAndGain) {
  const Record r = Mapped(
      "\"B.x\" = { column = \"probe 7\", unit = \"um\", gain = -0.5 }\n\"A.y\" = \"probe 7\"\n");
  EXPECT_NEAR(r.Find("B.x")->samples[1], -1e-5, 1e-18);
  EXPECT_NEAR(sources_.at("B.x").factor, -0.5e-6, 1e-18);
  EXPECT_EQ(sources_.at("B.x").column, "probe 7");
  EXPECT_EQ(r.Find("A.y")->samples[1], 20);  // without a unit: SI
  EXPECT_THAT(case_.notes[0], HasSubstr("left out: room temperature"));
}

// As MATLAB, a viewer of HDF5 files or the head of a CSV file writes the name; an own name of the
// file comes first.
TEST_F(CaseChannels, AColumnMayBeSpeltAsOtherProgramsShowIt) {
  for (const char* name : {"A_i1", "/A/i1", "A.i1 [mA]", "A.i1"}) {
    const Record r = Mapped(std::string("\"A.i2\" = \"") + name + "\"\n");
    ASSERT_NE(r.Find("A.i2"), nullptr) << name;
    EXPECT_NEAR(r.Find("A.i2")->samples[0], 0.5, 1e-12) << name;  // 500 mA of A.i1
  }
  raw_.channels.push_back({"A_i1", "A", {7, 7, 7, 7}});
  EXPECT_EQ(Mapped("\"A.i2\" = \"A_i1\"\n").Find("A.i2")->samples[0], 7);
}

// 2 ms late at 1 kHz: two rows earlier, the last two are not known.
TEST_F(CaseChannels, ALateColumnIsMovedBack) {
  Record r = Mapped("\"A.x\" = { late = 0.002 }\n");
  const std::vector<double>& x = r.Find("A.x")->samples;
  EXPECT_NEAR(x[0], 3e-6, 1e-18);
  EXPECT_NEAR(x[1], 4e-6, 1e-18);
  EXPECT_TRUE(std::isnan(x[2]) && std::isnan(x[3]));
  EXPECT_THAT(Message("\"A.x\" = { late = 1e9 }\n"),
              HasSubstr("late = 1e+09 s, allowed: less than the 0.004 s of log.csv"));
  r = Mapped("\"A.x\" = { late = -0.001 }\n");
  EXPECT_TRUE(std::isnan(r.Find("A.x")->samples[0]));
  EXPECT_NEAR(r.Find("A.x")->samples[1], 1e-6, 1e-18);
  EXPECT_NEAR(r.Find("A.i1")->samples[0], 0.5, 1e-12);  // the others stay
}

TEST_F(CaseChannels, AChannelThatIsNotUsedIsLeftOutSilently) {
  const Record r = Mapped("\"A.x\" = { use = false }\n");
  EXPECT_EQ(r.Find("A.x"), nullptr);
  EXPECT_NE(r.Find("A.i1"), nullptr);
  EXPECT_THAT(case_.notes[0], ::testing::Not(HasSubstr("A.x")));
}

// The same remark on several files is one line.
TEST_F(CaseChannels, RemarksOfSeveralFilesAreJoined) {
  Mapped("");
  Mapped("");
  ASSERT_EQ(case_.notes.size(), 1u);
  EXPECT_THAT(case_.notes[0], HasSubstr("log.csv, log.csv: columns without"));
}

TEST_F(CaseChannels, MistakesNameChannelColumnAndWhatThereIs) {
  EXPECT_THAT(Message("\"omgea\" = \"probe 7\"\n"),
              HasSubstr("is not a channel of this rig, did you mean omega?"));
  EXPECT_THAT(Message("\"B.x\" = \"probe 9\"\n"),
              HasSubstr("column \"probe 9\" of B.x is not in log.csv, allowed: "));
  EXPECT_THAT(Message("\"A.x\" = { gain = 0.0 }\n"), HasSubstr("gain = 0, allowed: any but 0"));
  EXPECT_THAT(Message("\"A.x\" = { colour = 1 }\n"), HasSubstr("colour"));
  EXPECT_THAT(Message("\"B.x\" = { column = \"probe 7\", unit = \"V\" }\n"), HasSubstr("B.x"));
}

}  // namespace
}  // namespace ambrig
