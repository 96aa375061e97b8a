#include "core/record/read_record.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/csv.h"
#include "core/record/hdf5.h"
#include "core/record/mat.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using testing::ErrorText;
using testing::TemporaryFolder;

TEST(ReadRecord, KnowsKindsByExtensionAndByContent) {
  const TemporaryFolder folder;
  const Record r{1000.0, 0.5, {{"A.x", "um", {1, 2, 3}}}};
  for (const char* name : {"a.h5", "a.HDF5", "h"}) WriteHdf5(r, folder.File(name));
  for (const char* name : {"a.csv", "a.txt", "c"}) WriteCsv(r, folder.File(name));
  for (const char* name : {"a.mat", "m.data"}) WriteMat(r, folder.File(name));
  for (const std::string& name : folder.Names()) {
    const Record back = ReadRecord(folder.File(name));
    EXPECT_EQ(back.rate, 1000.0) << name;
    EXPECT_EQ(back.start, 0.5) << name;
    ASSERT_EQ(back.channels.size(), 1u) << name;
    EXPECT_EQ(back.channels[0].name, "A.x") << name;
    EXPECT_EQ(back.channels[0].unit, "um") << name;
    EXPECT_EQ(back.channels[0].samples, r.channels[0].samples) << name;
  }
}

TEST(ReadRecord, TheContentDecidesBeforeTheExtension) {
  const TemporaryFolder folder;
  const Record r{1000.0, 0.5, {{"A.x", "um", {1, 2, 3}}}};
  WriteHdf5(r, folder.File("a.csv"));
  WriteMat(r, folder.File("b.h5"));
  WriteCsv(r, folder.File("c.mat"));
  for (const std::string& name : folder.Names())
    EXPECT_EQ(ReadRecord(folder.File(name)).Find("A.x")->samples, r.channels[0].samples) << name;
}

TEST(ReadRecord, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.File("a.bin");
  const auto error = [&] { return ErrorText<InputError>([&] { ReadRecord(path); }); };
  EXPECT_EQ(error(), path + ": no such file");
  testing::WriteBytes(path, std::string("\0\1\2,", 4));
  EXPECT_EQ(error(), path +
                         ": unknown kind of file, allowed MAT (.mat), HDF5 (.h5 .hdf5), TDMS "
                         "(.tdms), UFF 58 (.unv .uff .uf), LVM (.lvm), SR785 trace, CSV (.csv .txt "
                         ".tsv)");
  const std::pair<std::string, const char*> foreign[] = {
      {"MDF     4.10", "MDF file (MF4); export it as CSV or MAT"},
      {"PAR1", "Parquet file; export it as CSV"},
      {"PK\x03\x04", "spreadsheet"},
      {"TDSh", "index of a TDMS file"},
      {std::string("\xff\xfet\0", 4), "UTF-16 text"}};
  for (const auto& [bytes, what] : foreign) {
    testing::WriteBytes(path, bytes);
    EXPECT_NE(error().find(what), std::string::npos) << error();
  }
}

}  // namespace
}  // namespace ambrig
