#include "core/base/zip_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig::testing {
namespace {

std::string Unpacked(const std::string& zip, const std::string& to) {
  return ErrorText<InputError>([&] { UnpackZip(zip, to); });
}

TEST(ZipFile, ComesBackWithFoldersAndAnyBytes) {
  const TemporaryFolder f;
  std::string bytes;
  for (unsigned k = 0; k < 100000; ++k) bytes += static_cast<char>(k * k % 251);
  const std::vector<ZipEntry> entries{{"a.txt", "short"}, {"b/c/data.bin", bytes}, {"empty", ""}};
  WriteZip(f.File("one.zip"), entries);
  WriteZip(f.File("two.zip"), entries);
  const std::string zip = ReadBytes(f.File("one.zip"));
  EXPECT_EQ(ReadBytes(f.File("two.zip")), zip);
  EXPECT_LT(zip.size(), bytes.size() / 2);
  EXPECT_NE(zip.find("short"), std::string::npos);  // a few bytes are not compressed
  std::filesystem::create_directories(f.File("out"));
  UnpackZip(f.File("one.zip"), f.File("out"));
  EXPECT_EQ(ReadBytes(f.File("out/b/c/data.bin")), bytes);
  EXPECT_EQ(ReadBytes(f.File("out/a.txt")), "short");
  EXPECT_EQ(ReadBytes(f.File("out/empty")), "");
}

TEST(ZipFile, LeavesNothingOutsideOfTheFolder) {
  const TemporaryFolder f;
  std::filesystem::create_directories(f.File("out"));
  for (const char* name : {"../x", "a/../../x", "/tmp/ambrig_x"}) {
    WriteZip(f.File("bad.zip"), {{name, "x"}});
    EXPECT_NE(Unpacked(f.File("bad.zip"), f.File("out")).find("leads out of the archive"),
              std::string::npos)
        << name;
  }
  EXPECT_FALSE(std::filesystem::exists(f.File("x")));
}

TEST(ZipFile, DamagedFilesAreNoArchive) {
  const TemporaryFolder f;
  std::filesystem::create_directories(f.File("out"));
  WriteZip(f.File("good.zip"), {{"data", std::string(5000, 'a') + std::string(5000, 'b')}});
  const std::string good = ReadBytes(f.File("good.zip"));
  WriteBytes(f.File("cut.zip"), good.substr(0, good.size() - 10));
  EXPECT_NE(Unpacked(f.File("cut.zip"), f.File("out")).find("cannot be unpacked"),
            std::string::npos);
  std::string wrong = good;
  for (std::size_t k = 40; k < 50; ++k) wrong[k] = static_cast<char>(~wrong[k]);
  WriteBytes(f.File("wrong.zip"), wrong);
  EXPECT_NE(Unpacked(f.File("wrong.zip"), f.File("out")), "");
  EXPECT_NE(Unpacked(f.File("absent.zip"), f.File("out")).find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace ambrig::testing
