// LVM files and segments after the specification (SOURCE.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/read_record.h"
#include "core/record/units.h"
#include "tests/core/record/formats/instrument_files.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::InstrumentFile;

TEST(LabviewText, DecimalCommaWithoutAColumnOfTimes) {
  std::string format;
  Record r = ReadMeasurement(InstrumentFile("lvm_comma.lvm"), &format).record;
  EXPECT_EQ(format, "LVM");
  EXPECT_EQ(r.rate, 8000);  // Delta_X 1,250000E-4
  EXPECT_EQ(r.rows(), 10U);
  ASSERT_EQ(r.channels.size(), 2U);
  EXPECT_EQ(r.channels[0].name, "Load cell (left)");
  EXPECT_EQ(r.channels[0].unit, "Newtons");
  EXPECT_EQ(r.channels[0].samples[6], 0.973848);
  EXPECT_EQ(r.channels[1].samples[9], 6.5);
  ConvertToSi(r);
  EXPECT_EQ(r.channels[0].unit, "N");
  EXPECT_EQ(r.channels[1].unit, "m/s2");
}

TEST(LabviewText, AColumnOfTimesForEveryChannel) {
  const Record r = ReadRecord(InstrumentFile("lvm_multi.lvm"));
  EXPECT_EQ(r.rate, 51200);
  ASSERT_EQ(r.channels.size(), 2U);
  EXPECT_EQ(r.channels[0].name, "Supply");
  EXPECT_EQ(r.channels[0].unit, "Volts");
  EXPECT_THAT(r.channels[0].samples, ElementsAre(0, 0.29552, 0.564642));
  EXPECT_EQ(r.channels[1].name, "Foot");
  EXPECT_EQ(r.channels[1].unit, "g");
  EXPECT_THAT(r.channels[1].samples, ElementsAre(-2.5, -1.5, -0.5));
}

TEST(LabviewText, EmptyChannelsAreLeftOutWithANote) {
  const Record r = ReadRecord(InstrumentFile("lvm_empty_fields.lvm"));
  EXPECT_EQ(r.rate, 1000);
  std::vector<std::string> names;
  for (const Channel& c : r.channels) names.push_back(c.name);
  EXPECT_THAT(names, ElementsAre("Rack0/Ai0", "Rack0/Ai2", "Rack0/Ai0 1"));
  EXPECT_EQ(r.channels[1].samples[2], -0.5);
  EXPECT_EQ(r.notes.size(), 4U);
  EXPECT_THAT(r.notes[0], HasSubstr("Untitled has no rows, left out"));
}

TEST(LabviewText, UnevenTimesAreRefusedWithTheirRow) {
  const std::string path = InstrumentFile("lvm_uneven.lvm");
  EXPECT_EQ(ErrorText<InputError>([&] { ReadRecord(path); }),
            path +
                ": X_Value of Öldruck (MPa): row 3: time 1.25 s is not uniform: step 1 s, expected "
                "0.25 s");
}

class Segments : public ::testing::Test {
 protected:
  static std::string Head(const std::string& separator) {
    return "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\t" + separator +
           "\nMulti_Headings\tYes\nX_Columns\tNo\n***End_of_Header***\t\n\t\n";
  }
  static std::string Segment(const std::string& time, const std::string& x0,
                             const std::string& rows, const std::string& name = "z") {
    return "Channels\t1\t\nSamples\t2\t\nDate\t2024/05/01\t\nTime\t" + time +
           "\t\nX_Dimension\tTime\t\nX0\t" + x0 +
           "\t\nDelta_X\t0.500000\t\n***End_of_Header***\t\t\nX_Value\t" + name + "\tComment\n" +
           rows + "\n";
  }
  Record Read(const std::string& text) {
    testing::WriteBytes(path_, text);
    return ReadRecord(path_);
  }
  std::string Error(const std::string& text) {
    const std::string error = ErrorText<InputError>([&] { Read(text); });
    return error.starts_with(path_) ? error.substr(path_.size()) : "wrong file: " + error;
  }

  const testing::TemporaryFolder folder_;
  const std::string path_ = folder_.File("a.lvm");
};

TEST_F(Segments, ThatFollowEachOtherAreOneRecord) {
  // By their X0, or by their clock with the same X0 (here over midnight of a second).
  for (const auto& [time, x0] : {std::pair("12:00:00.9", "1.0"), std::pair("12:00:01.9", "0.0")}) {
    const Record r = Read(Head("Tab") + Segment("12:00:00.9", "0.0", "\t1\n\t2\n") +
                          Segment(time, x0, "\t3\n\t4\tnote\n"));
    EXPECT_EQ(r.rate, 2);
    EXPECT_THAT(r.Find("z")->samples, ElementsAre(1, 2, 3, 4)) << x0;
  }
  EXPECT_EQ(
      Error(Head("Tab") + Segment("12:00:00", "0.0", "\t1\n\t2\n") +
            Segment("12:00:02", "0.0", "\t3\n\t4\n")),
      ": segment 2 of z begins at 2 s, expected 1 s; segments with gaps between them are records "
      "of their own");
  EXPECT_EQ(Error(Head("Tab") + Segment("12:00:00", "0.0", "\t1\n\t2\n") +
                  Segment("12:00:01", "0.0", "\t3\n\t4\n", "y")),
            ": segment 2 has other channels than the first; they are records of their own");
}

TEST_F(Segments, CommasAsSeparators) {
  std::string text = Head("Comma") + Segment("12:00:00", "0.25", "\t1.5\n\t2.5\n");
  for (char& c : text)
    if (c == '\t') c = ',';
  const Record r = Read(text);
  EXPECT_EQ(r.start, 0.25);
  EXPECT_THAT(r.Find("z")->samples, ElementsAre(1.5, 2.5));
}

TEST_F(Segments, Errors) {
  EXPECT_EQ(Error(Head("Tab") + Segment("12:00:00", "0.0", "\t1\n\t2x\n")),
            ":19:2: '2x' is not a number");
  EXPECT_EQ(Error("LabVIEW Measurement\nSeparator\tBar\n"),
            ":2: 'Separator\tBar', allowed: Tab, Comma");
  EXPECT_EQ(Error("LabVIEW Measurement\nX_Columns\tNo\n"),
            ":2: the head of the file does not end with ***End_of_Header***");
  EXPECT_EQ(Error(Head("Tab")), ": no segment of data behind the head");
}

}  // namespace
}  // namespace ambrig
