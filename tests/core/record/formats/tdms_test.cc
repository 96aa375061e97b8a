// TDMS files written byte by byte after the published structure (make_instruments.py).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/read_record.h"
#include "tests/core/record/formats/instrument_files.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::InstrumentFile;
using ::testing::Pointwise;
using testing::SignalX;
using testing::SignalY;

TEST(Tdms, SegmentsThatReuseTheirObjectsInBothByteOrders) {
  for (const char* name : {"tdms_little.tdms", "tdms_big.tdms"}) {
    std::string format;
    const Record r = ReadMeasurement(InstrumentFile(name), &format).record;
    EXPECT_EQ(format, "TDMS");
    EXPECT_EQ(r.rate, 1000) << name;
    EXPECT_EQ(r.start, 0.25) << name;
    ASSERT_EQ(r.channels.size(), 2U) << name;
    EXPECT_EQ(r.channels[0].name, "A.x");
    EXPECT_EQ(r.channels[0].unit, "um");
    EXPECT_EQ(r.channels[0].samples, SignalX()) << name;
    EXPECT_EQ(r.channels[1].name, "A.i1");
    EXPECT_EQ(r.channels[1].unit, "A");
    EXPECT_EQ(r.channels[1].samples, SignalY()) << name;  // integers with a linear scale
    EXPECT_TRUE(r.notes.empty());
  }
}

TEST(Tdms, InterleavedChannelsOfTwoTypes) {
  const Record r = ReadRecord(InstrumentFile("tdms_interleaved.tdms"));
  EXPECT_THAT(r.Find("A.x")->samples, Pointwise(DoubleNear(6e-8), SignalX()));  // single precision
  EXPECT_EQ(r.Find("A.i1")->samples, SignalY());
}

TEST(Tdms, AProgramThatWasStoppedLosesItsLastRow) {
  const Record r = ReadRecord(InstrumentFile("tdms_stopped.tdms"));
  EXPECT_EQ(r.Find("A.x")->samples, SignalX(6));
  EXPECT_EQ(r.Find("A.i1")->samples, SignalY(6));
}

TEST(Tdms, TimeStampsAreTheTimeBase) {
  const Record r = ReadRecord(InstrumentFile("tdms_times.tdms"));
  EXPECT_EQ(r.rate, 1000);
  EXPECT_EQ(r.start, 0);
  ASSERT_EQ(r.channels.size(), 1U);
  EXPECT_EQ(r.channels[0].name, "log/bus");  // two groups have a channel "bus"
  EXPECT_EQ(r.rows(), 300U);
  EXPECT_EQ(r.channels[0].samples[299], 299);
  EXPECT_THAT(r.notes,
              ElementsAre(HasSubstr("slow/bus is not as long as the channel of times, left out")));
}

TEST(Tdms, DaqmxRawDataAreRefused) {
  const std::string path = InstrumentFile("tdms_daqmx.tdms");
  EXPECT_THAT(
      ErrorText<InputError>([&] { ReadRecord(path); }),
      AllOf(HasSubstr(path + ": byte "), HasSubstr("DAQmx raw data, which cannot be read; save")));
}

TEST(Tdms, DamageIsNamedByItsByte) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.File("a.tdms");
  const std::string whole = testing::ReadBytes(InstrumentFile("tdms_little.tdms"));
  const auto error = [&](std::size_t at, const std::string& bytes) {
    std::string damaged = whole;
    testing::WriteBytes(path, damaged.replace(at, bytes.size(), bytes));
    const std::string text = ErrorText<InputError>([&] { ReadRecord(path); });
    return text.starts_with(path) ? text.substr(path.size()) : "wrong file: " + text;
  };
  EXPECT_EQ(error(8, std::string(4, '\1')), ": byte 12: version 16843009, allowed 4712, 4713");
  // The number of objects, and the length of the first path.
  EXPECT_THAT(error(28, "\xff\xff\xff\x7f"), HasSubstr(": byte "));
  EXPECT_EQ(error(32, "\xff\xff\xff\x7f"), ": byte 36: 2147483647 bytes expected, the file has " +
                                               std::to_string(whole.size() - 36));
  const std::size_t index = whole.find("/'bench'/'A.x'") + 14;  // length, type, dimension, values
  EXPECT_THAT(error(index + 4, std::string("\x0b", 1)),
              HasSubstr("values of type 0xb, allowed integers, single, double"));
  EXPECT_THAT(error(index + 12, "\xff\xff\xff\xff\xff"),
              HasSubstr("a chunk of raw data larger than the file"));
  EXPECT_THAT(error(0, "TDSh"), HasSubstr("is the index of a TDMS file; the data are in"));
}

TEST(Tdms, UnknownScalesAreRefused) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.File("a.tdms");
  std::string bytes = testing::ReadBytes(InstrumentFile("tdms_little.tdms"));
  bytes.replace(bytes.find("Linear", bytes.find("Scale_Type")), 6, "Tabled");
  testing::WriteBytes(path, bytes);
  EXPECT_EQ(
      ErrorText<InputError>([&] { ReadRecord(path); }),
      path +
          ": bench/A.i1 has a scale of kind 'Tabled', allowed: Linear, Polynomial; save it scaled");
}

}  // namespace
}  // namespace ambrig
