#include "core/record/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/record/text_table.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using testing::ErrorText;
using testing::TemporaryFolder;

class Csv : public ::testing::Test {
 protected:
  Record Read(const std::string& text, const CsvOptions& options = {}) {
    testing::WriteBytes(path_, text);
    return ReadCsv(path_, options);
  }
  /// The error without the name of the file.
  std::string Error(const std::string& text, const CsvOptions& options = {}) {
    const std::string error = ErrorText<InputError>([&] { Read(text, options); });
    return error.starts_with(path_) ? error.substr(path_.size()) : "wrong file: " + error;
  }

  TemporaryFolder folder_;
  const std::string path_ = folder_.File("a.csv");
};

TEST_F(Csv, HeaderGivesNamesUnitsAndTime) {
  const Record r = Read("t [s],A.x [um],bus\n0.5,1,-2e-3\n0.501,+3.5,\n0.502,nan,48\n");
  EXPECT_EQ(r.rate, 1000.0);
  EXPECT_EQ(r.start, 0.5);
  ASSERT_EQ(r.channels.size(), 2u);
  EXPECT_EQ(r.channels[0].name, "A.x");
  EXPECT_EQ(r.channels[0].unit, "um");
  EXPECT_EQ(r.channels[0].samples[1], 3.5);
  EXPECT_TRUE(std::isnan(r.channels[0].samples[2]));
  EXPECT_EQ(r.channels[1].unit, "");
  EXPECT_EQ(r.channels[1].samples[0], -2e-3);
  EXPECT_TRUE(std::isnan(r.channels[1].samples[1]));
}

TEST_F(Csv, SeparatorIsTheHeaders) {
  for (const char* text :
       {"t[s],z[m]\n0,1\n1,2.5", "t_s,z [m]\n0,1\n1,2.5\n", "t[s];z[m]\r\n0;1\r\n1;2,5\r\n",
        "# made by a logger\n\"t [s]\"\t\"z [m]\"\n0\t1\n1\t2.5\n\n",
        "\xef\xbb\xbftime[s] , z [m]\n 0 , 1\n 1, 2.5 \n"}) {
    const Record r = Read(text);
    EXPECT_EQ(r.rate, 1.0) << text;
    ASSERT_NE(r.Find("z"), nullptr) << text;
    EXPECT_EQ(r.Find("z")->unit, "m") << text;
    EXPECT_THAT(r.Find("z")->samples, ElementsAre(1, 2.5)) << text;
  }
}

TEST_F(Csv, TimeMayHaveAnotherUnitAndFewDigits) {
  EXPECT_NEAR(Read("t [ms],z\n0,1\n0.04,2\n0.08,3\n").rate, 25000.0, 1e-8);
  // 30 kHz with microseconds: each row is off by at most half a microsecond, 1.5 % of a period.
  const Record r = Read("t,z\n0,1\n0.000033,2\n0.000067,3\n0.000100,4\n");
  EXPECT_NEAR(r.rate, 30000.0, 1e-6);
}

TEST_F(Csv, OptionsGiveUnitsAndRate) {
  const Record r = Read("z [mm],bus\n1,2\n3,4\n", {{{"z", "um"}}, 500.0, 0.25});
  EXPECT_EQ(r.rate, 500.0);
  EXPECT_EQ(r.start, 0.25);
  EXPECT_EQ(r.Find("z")->unit, "um");
  EXPECT_EQ(Error("t,z\n0,1\n1,2\n", {{}, 2.0, 0.0}), ": rate = 2 Hz, but the times have 1 Hz");
  EXPECT_EQ(Error("x,z\n0,1\n1,2\n"),
            ": neither a rate [Hz] nor a time channel, allowed: t, time (s), t [ms], t_ms, Time "
            "(ms), with units s, ms, us, ns; there are: x, z; a table of values at rest is a "
            "[[record]] of a case with kind = \"static\"");
}

TEST_F(Csv, TimeByTheNamesThatLoggersGive) {
  for (const char* head : {"t_ms,z", "Time [ms],z", "Time (ms),z", "TIME_ms,z"}) {
    const Record r = Read(std::string(head) + "\n0,1\n10,2\n20,3\n");
    EXPECT_DOUBLE_EQ(r.rate, 100) << head;
    EXPECT_EQ(r.channels.size(), 1U) << head;
  }
}

TEST_F(Csv, ErrorsNameLineAndColumn) {
  EXPECT_EQ(Error("t,A.x [um]\n0,1\n1, 2x\n"), ":3:4: A.x: '2x' is not a number");
  EXPECT_EQ(Error("t,z\n0,1\n1\n"), ":3:2: 1 cells, header has 2");
  EXPECT_EQ(Error("t,z\n0,1,2\n"), ":2:5: more cells than the header's 2");
  EXPECT_EQ(Error("t,z [m\n0,1\n"), ":1:3: ']' expected after the unit of z");
  EXPECT_EQ(Error("t,,z\n"), ":1:3: column without a name");
  EXPECT_EQ(Error("0,1\n1,2\n"), ":1:1: header expected, e.g. t [s],A.x [um]");
  EXPECT_EQ(Error("t,z\n0,1\n\n1,2\n"), ":3:1: blank line between rows");
  EXPECT_EQ(Error("t,z\n0,1e999\n"), ":2:3: z: '1e999' is not a number");
  EXPECT_EQ(Error(""), ": no header, expected e.g. t [s],A.x [um]");
  EXPECT_EQ(Error("t,z,z\n0,1,2\n1,1,2\n"), ": channel z is there twice");
  EXPECT_EQ(Error("t\n0\n1\n"), ": no channels");
  EXPECT_EQ(Error("t [A],z\n0,1\n1,2\n"), ": t: unit A, allowed s, ms, us, ns");
}

TEST_F(Csv, TimeThatIsNotUniformIsReportedWithItsRow) {
  EXPECT_EQ(Error("t,z\n0,1\n0.1,2\n0.3,3\n0.4,4\n"),
            ": column t: row 4: time 0.3 s is not uniform: step 0.2 s, expected 0.1 s");
  EXPECT_EQ(Error("t,z\n0,1\n0.1,2\n0.1,3\n"), ": column t: row 4: time 0.1 s does not increase");
  EXPECT_EQ(Error("t,z\n0,1\n,2\n0.2,3\n"), ": column t: row 3: time nan s is not a number");
  EXPECT_EQ(Error("t,z\n0,1\n"), ": column t: a time column needs at least two rows");
  // A drift of 1 % per row: no single step looks wrong, the whole does.
  std::string drift = "t,z\n";
  for (int k = 0; k < 40; ++k) drift += std::to_string(k + 0.001 * k * k) + ",1\n";
  EXPECT_NE(Error(drift).find("is not uniform"), std::string::npos);
}

TEST_F(Csv, WritesWhatItReads) {
  Record r{12500.0, 0.125};
  r.channels = {{"A.x", "m", {0.1, 1.0 / 3, -0.0}}, {"bus", "", {std::nan(""), 5e-324, 1e300}}};
  WriteCsv(r, path_);
  EXPECT_EQ(testing::ReadBytes(path_),
            "t [s],A.x [m],bus\n0.125,0.1,\n0.12508,0.3333333333333333,5e-324\n"
            "0.12516,-0,1e+300\n");
  const Record back = ReadCsv(path_);
  EXPECT_EQ(back.rate, r.rate);
  EXPECT_EQ(back.start, r.start);
  EXPECT_EQ(back.channels[0].samples, r.channels[0].samples);
  EXPECT_EQ(back.channels[1].samples[1], 5e-324);
  EXPECT_TRUE(std::isnan(back.channels[1].samples[0]));
}

TEST_F(Csv, RefusesNamesThatWouldReadDifferently) {
  const std::string text = ErrorText<InputError>([&] {
    WriteCsv(Record{1.0, 0.0, {{"a,b", "m", {1, 2}}}}, path_);
  });
  EXPECT_EQ(text, "cannot write " + path_ + ": channel name 'a,b', unit 'm'");
}

// "1" is a number, and a unit only in a line where others are units.
TEST(TextTable, AFirstRowOfOnesIsNoLineOfUnits) {
  const TextTable row = ReadTextTable("a.csv", "x,F,G\n,1,1\n1,2,3\n");
  ASSERT_EQ(row.columns.size(), 3U);
  EXPECT_EQ(row.columns[1].samples, (std::vector<double>{1, 2}));
  EXPECT_EQ(row.columns[1].unit, "");
  const TextTable units = ReadTextTable("a.csv", "t,F\ns,1\n0,2\n");
  EXPECT_EQ(units.columns[0].unit, "s");
  EXPECT_EQ(units.columns[1].samples, (std::vector<double>{2}));
}

}  // namespace
}  // namespace ambrig
