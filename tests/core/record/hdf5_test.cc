#include "core/record/hdf5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <thread>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using testing::ErrorText;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadBytes;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using testing::WriteBytes;

const std::string kForeign = AMBRIG_SOURCE_DIR "/tests/core/data/foreign.h5";

Record Example() {
  Record r{12500.0, 0.125};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  r.channels = {{"theta", "rad", {0.1, -0.0, 1e300, nan}}, {"A.x", "m", {1, 2, 3, 4.0 / 3}}};
  r.attributes = {{"parameters", "gap = 4e-4\n"}, {"empty", ""}};
  return r;
}

std::string OneLineError(const std::string& path) {
  const std::string text = ErrorText<InputError>([&] { ReadHdf5(path); });
  EXPECT_THAT(text, StartsWith(path + ": "));
  EXPECT_THAT(text, Not(HasSubstr("\n")));
  return text;
}

TEST(Hdf5, ReturnsTheSameBitsInTheSameOrder) {
  const TemporaryFolder folder;
  const Record before = Example();
  WriteHdf5(before, folder.File("a.h5"));
  const Record after = ReadHdf5(folder.File("a.h5"));
  EXPECT_EQ(after.rate, 12500.0);
  EXPECT_EQ(after.start, 0.125);
  EXPECT_EQ(after.attributes, before.attributes);
  EXPECT_TRUE(after.notes.empty());
  ASSERT_EQ(after.channels.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(after.channels[c].name, before.channels[c].name);
    EXPECT_EQ(after.channels[c].unit, before.channels[c].unit);
    ASSERT_EQ(after.channels[c].samples.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(after.channels[c].samples[k]),
                std::bit_cast<std::uint64_t>(before.channels[c].samples[k]));
  }
}

TEST(Hdf5, LongRecordsCompressAndAttributesMayExceed64Kilobytes) {
  const TemporaryFolder folder;
  Record r{1000.0, 0.0};
  r.channels = {{"z", "m", std::vector<double>(100001, 0.25)}};
  r.channels[0].samples.back() = 7;
  r.attributes["rig"] = std::string(200000, 'x') + "end";
  WriteHdf5(r, folder.File("a.h5"));
  const Record back = ReadHdf5(folder.File("a.h5"));
  EXPECT_EQ(back.channels[0].samples, r.channels[0].samples);
  EXPECT_EQ(back.attributes, r.attributes);
  EXPECT_LT(ReadBytes(folder.File("a.h5")).size(), 300000u);  // 800 kB of samples uncompressed
}

TEST(Hdf5, SameRecordSameBytesAlsoSecondsLater) {
  const TemporaryFolder folder;
  WriteHdf5(Example(), folder.File("a.h5"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5's times count seconds
  WriteHdf5(Example(), folder.File("b.h5"));
  EXPECT_EQ(ReadBytes(folder.File("a.h5")), ReadBytes(folder.File("b.h5")));
}

TEST(Hdf5, EmptyChannelsSurvive) {
  const TemporaryFolder folder;
  WriteHdf5(Record{1.0, 0.0, {{"z", "m", {}}}}, folder.File("a.h5"));
  EXPECT_EQ(ReadHdf5(folder.File("a.h5")).rows(), 0u);
}

TEST(Hdf5, ReadsWhatOtherProgramsWrite) {
  const Record r = ReadHdf5(kForeign);
  EXPECT_EQ(r.rate, 25000.0);  // an integer array of one
  EXPECT_EQ(r.start, 0.0);
  ASSERT_NE(r.Find("A.x"), nullptr);
  EXPECT_EQ(r.Find("A.x")->unit, "\u00b5m");  // variable length
  EXPECT_EQ(r.Find("A.x")->samples[1], -1.25);
  EXPECT_TRUE(std::isnan(r.Find("A.x")->samples[2]));
  EXPECT_EQ(r.Find("A.i1")->unit, "mA");  // padded with blanks, n x 1
  EXPECT_THAT(r.Find("A.i1")->samples, ElementsAre(-7, 0, 1, 2e9));
  EXPECT_THAT(r.Find("A.r.y")->samples, ElementsAre(-7, 0, 1, 2e9));
  EXPECT_EQ(r.Find("bus")->unit, "V");
  EXPECT_EQ(r.channels.size(), 4u);
  EXPECT_EQ(r.attributes.at("logger"), "DAQ 7");
  EXPECT_THAT(r.notes, ElementsAre(EndsWith("A.ring is a link, left out"),
                                   EndsWith("alias is a link, left out"),
                                   EndsWith("matrix is not a vector of numbers, left out")));
}

TEST(Hdf5, TimeChannelIsTheTimeBase) {
  const TemporaryFolder folder;
  Record r = Example();
  r.channels.push_back({"t", "s", {0.125, 0.12508, 0.12516, 0.12524}});
  WriteHdf5(r, folder.File("a.h5"));
  EXPECT_EQ(ReadHdf5(folder.File("a.h5")).Find("t"), nullptr);
  r.channels.back().samples = {0.125, 0.126, 0.127, 0.128};
  WriteHdf5(r, folder.File("b.h5"));
  EXPECT_THAT(OneLineError(folder.File("b.h5")), EndsWith("rate = 12500 Hz, but t has 1000 Hz"));
}

TEST(Hdf5, ErrorsAreOneLine) {
  const TemporaryFolder folder;
  EXPECT_THAT(OneLineError(folder.File("none.h5")), EndsWith("no such file"));
  EXPECT_THAT(OneLineError(folder.File("")), EndsWith("not a file"));
  WriteBytes(folder.File("text.h5"), "t [s],A.x [um]\n0,1\n");
  EXPECT_THAT(OneLineError(folder.File("text.h5")), EndsWith("not an HDF5 file"));
  WriteBytes(folder.File("empty.h5"), "");
  OneLineError(folder.File("empty.h5"));
}

// (Flipped bits are another matter: HDF5 1.10 itself crashes on some.)
TEST(Hdf5, TruncatedFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string own = folder.File("own.h5"), path = folder.File("cut.h5");
  WriteHdf5(Example(), own);
  for (const std::string& source : {own, kForeign}) {
    const std::string whole = ReadBytes(source);
    for (std::size_t size = 1; size < whole.size(); size += 97) {
      WriteBytes(path, whole.substr(0, size));
      EXPECT_NE(OneLineError(path), "") << size;
    }
  }
}

TEST(Hdf5, RefusesRecordsThatCannotBeReadBack) {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.h5");
  const auto error = [&](const Record& r) {
    return ErrorText<InputError>([&] { WriteHdf5(r, path); });
  };
  Record r = Example();
  r.channels[1].samples.pop_back();
  EXPECT_EQ(error(r), "cannot write " + path + ": channel A.x has 3 rows, theta has 4");
  r = Example();
  r.channels[1].name = "theta";
  EXPECT_EQ(error(r), "cannot write " + path + ": channel theta is there twice");
  r.channels[1].name = "A/x";
  EXPECT_EQ(error(r), "cannot write " + path + ": channel name 'A/x'");
  r = Example();
  r.rate = 0;
  EXPECT_THAT(error(r), HasSubstr("neither a rate"));
  EXPECT_TRUE(folder.Names().empty());
}

// The size limit of the process stands for a full disk.
TEST(Hdf5, AFullDiskLeavesTheOldFile) {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.h5");
  WriteHdf5(Example(), path);
  const std::string old = ReadBytes(path);
  Record large = Example();
  for (Channel& c : large.channels)
    for (int k = 0; k < 20000; ++k) c.samples.push_back(std::sin(1.0 * k * k));
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small = {20000, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string text = ErrorText<InputError>([&] { WriteHdf5(large, path); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(text, "cannot write " + path + ": File too large");
  EXPECT_EQ(ReadBytes(path), old);
  EXPECT_THAT(folder.Names(), ElementsAre("a.h5"));
}

}  // namespace
}  // namespace ambrig
