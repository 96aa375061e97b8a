// Text tables as oscilloscopes, loggers and spreadsheets write them; dates and times of day.
#include "core/record/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/column_names.h"
#include "core/record/date_time.h"
#include "core/record/read_record.h"
#include "core/record/text_cells.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using testing::ErrorText;
using ::testing::HasSubstr;

class TextTables : public ::testing::Test {
 protected:
  Record Read(const std::string& text) {
    testing::WriteBytes(path_, text);
    return ReadRecord(path_);
  }
  std::string Error(const std::string& text) {
    const std::string error = ErrorText<InputError>([&] { Read(text); });
    return error.starts_with(path_) ? error.substr(path_.size()) : "wrong file: " + error;
  }

  const testing::TemporaryFolder folder_;
  const std::string path_ = folder_.File("a.csv");
};

TEST_F(TextTables, UnitsInHeads) {
  // Latin-1 for the micro sign; a bracket that holds no unit belongs to the name.
  const Record r =
      Read("Time (s);x (\xb5m);Force (left);i / A;u [V]\n0,0;1,5;2;3;4\n0,5;2,5;3;4;5\n");
  EXPECT_EQ(r.rate, 2);
  ASSERT_EQ(r.channels.size(), 4U);
  EXPECT_EQ(r.channels[0].name, "x");
  EXPECT_EQ(r.channels[0].unit, "µm");
  EXPECT_EQ(r.channels[0].samples[1], 2.5);
  EXPECT_EQ(r.channels[1].name, "Force (left)");
  EXPECT_EQ(r.channels[2].name, "i");
  EXPECT_EQ(r.channels[2].unit, "A");
  EXPECT_EQ(r.channels[3].unit, "V");
  // By the name that stands in the file, too.
  EXPECT_EQ(FindColumn(r, "x (um)"), &r.channels[0]);
  EXPECT_EQ(FindColumn(r, "i / A"), &r.channels[2]);
  EXPECT_EQ(FindColumn(r, "u [V]"), &r.channels[3]);
}

TEST_F(TextTables, ALineOfUnitsBelowTheNames) {
  // As PicoScope writes it, and without brackets.
  for (const char* units : {"(ms),(mV)\n\n", "[ms],[mV]\n", "ms,mV\n"}) {
    const Record r = Read(std::string("Time,Channel A\n") + units + "-1,10\n0,20\n1,30\n");
    EXPECT_EQ(r.rate, 1000) << units;
    EXPECT_EQ(r.start, -1e-3) << units;
    EXPECT_EQ(r.channels[0].unit, "mV") << units;
    EXPECT_EQ(r.rows(), 3U) << units;
  }
}

TEST_F(TextTables, SpreadsheetHabits) {
  // A line sep=, quoted cells with decimal commas, a separator behind every line.
  EXPECT_THAT(Read("sep=;\nt;x;\n0;1;\n1;2;\n").Find("x")->samples, ElementsAre(1, 2));
  EXPECT_THAT(Read("t,x\n\"0,0\",\"1,5\"\n\"0,5\",\"2,5\"\n").Find("x")->samples,
              ElementsAre(1.5, 2.5));
  EXPECT_EQ(Error("t;x\n0;1.234,5\n1;2\n"), ":2:3: x: '1.234,5' is not a number");
}

TEST_F(TextTables, AColumnOfWordsIsLeftOut) {
  const Record r = Read("t,state,x\n0,pushed,1\n1,,2\n2,\"mid, 1\",3\n");
  ASSERT_EQ(r.channels.size(), 1U);
  EXPECT_THAT(r.channels[0].samples, ElementsAre(1, 2, 3));
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("state holds words, left out")));
  // A word among numbers, whichever comes first, is a mistake; so are times in words and bad
  // numbers.
  EXPECT_EQ(Error("t,x\n0,1\n1,off\n"), ":3:3: x: 'off' is not a number");
  EXPECT_EQ(Error("t,x\n0,off\n1,2\n"), ":2:3: x: 'off' is not a number");
  EXPECT_EQ(Error("t,x\nsoon,1\nlater,2\n"), ":2:1: t: 'soon' is not a number");
  EXPECT_EQ(Error("t,x\n0,2x\n1,3x\n"), ":2:3: x: '2x' is not a number");
  EXPECT_EQ(Error("t,x\n0,a\n1,b\n"), ": no channels");
}

TEST_F(TextTables, DatesAndTimesOfDayBecomeSeconds) {
  const char* files[] = {
      "timestamp,x\n2024-05-01T23:59:59.500,1\n2024-05-02T00:00:00.000,2\n2024-05-02T00:00:00.500,"
      "3\n",
      "time;x\n01.05.2024 23:59:59,5;1\n02.05.2024 00:00:00,0;2\n02.05.2024 00:00:00,5;3\n",
      "Date,Time,x\n2024/05/01,23:59:59.5,1\n2024/05/02,00:00:00.0,2\n2024/05/02,00:00:00.5,3\n",
      "t,x\n2024-05-01 23:59:59.5Z,1\n2024-05-02 01:00:00+01:00,2\n2024-05-01T19:00:00.5-0500,3\n"};
  for (const char* text : files) {
    const Record r = Read(text);
    EXPECT_EQ(r.rate, 2) << text;
    EXPECT_EQ(r.start, 0) << text;
    ASSERT_EQ(r.channels.size(), 1U) << text;
    EXPECT_THAT(r.channels[0].samples, ElementsAre(1, 2, 3)) << text;
  }
  EXPECT_EQ(Read(files[0]).attributes.at("first_instant"), "2024-05-01T23:59:59.500");
}

TEST_F(TextTables, MicrosecondsOfADateKeepTheirDigits) {
  std::string text = "time,x\n";
  char row[64];
  for (int k = 0; k < 200; ++k) {
    std::snprintf(row, sizeof row, "2024-05-01T12:00:00.%06d,%d\n", 40 * k, k);
    text += row;
  }
  EXPECT_EQ(Read(text).rate, 25000);
}

TEST_F(TextTables, ATimeInSecondsComesBeforeDates) {
  const Record r = Read("t [s],date,x\n0,2024-05-01,1\n1,2024-05-01,2\n");
  EXPECT_EQ(r.rate, 1);
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("date holds dates or times of day, left out")));
}

TEST_F(TextTables, ErrorsOfDates) {
  EXPECT_EQ(Error("time,x\n2024-05-01T12:00:00,1\nnever,2\n"),
            ":3:1: time: 'never' is not a date or time of day like '2024-05-01T12:00:00'");
  EXPECT_EQ(Error("time,x\n2024-02-30T12:00:00,1\n"),
            ":2:1: time: '2024-02-30T12:00:00' is not a number");
  EXPECT_THAT(Error("time,x\n23:59:59,1\n00:00:00,2\n"), HasSubstr("does not increase"));
}

TEST(DateTimes, Instants) {
  const auto seconds = [](const char* text) { return ParseDateTime(text)->seconds; };
  EXPECT_EQ(seconds("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(seconds("2000-03-01"), 951868800);  // date -d 2000-03-01T00:00Z +%s
  EXPECT_EQ(seconds("2024-02-29 12:34:56+02:00"), 1709202896);
  EXPECT_EQ(seconds("12:34"), 45240);
  EXPECT_DOUBLE_EQ(ParseDateTime("12:34:56.123456789")->fraction, 0.123456789);
  for (const char* text : {"", "1.5", "2024", "2024-13-01", "2024-1-1T", "24:00:00", "12:60",
                           "12:0", "12:00:00.", "12:00:00x", "2024-05-01T12:00:00+2", "31.02.2024"})
    EXPECT_FALSE(ParseDateTime(text)) << text;
}

TEST(TextCells, Latin1BecomesUtf8) {
  EXPECT_EQ(Utf8("\xb5m/s\xb2"), "µm/s²");
  EXPECT_EQ(Utf8("µm/s²"), "µm/s²");
  EXPECT_EQ(Utf8("\xc3"), "Ã");
  EXPECT_EQ(Utf8("\xed\xa0\x80"), "í\xc2\xa0\xc2\x80");  // a surrogate is no UTF-8
}

}  // namespace
}  // namespace ambrig
