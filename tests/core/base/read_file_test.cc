// Files in memory, and what a file that names another means.
#include "core/base/read_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

std::string RefusalOf(const std::string& path) {
  try {
    ReadFile(path);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

class ReadFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = folder_.File("bytes");
    bytes_.resize(200001);  // more than one block
    for (std::size_t k = 0; k < bytes_.size(); ++k) bytes_[k] = static_cast<char>(k * 7 % 256);
    std::ofstream(path_, std::ios::binary) << bytes_;
  }
  testing::TemporaryFolder folder_;
  std::string path_, bytes_;
};

TEST_F(ReadFileTest, GivesEveryByte) { EXPECT_EQ(ReadFile(path_), bytes_); }

TEST_F(ReadFileTest, StopsAtTheLimit) {
  for (const std::size_t limit : {0u, 1u, 65535u, 65536u, 65537u, 200000u})
    EXPECT_EQ(ReadFile(path_, limit), bytes_.substr(0, limit)) << limit;
  EXPECT_EQ(ReadFile(path_, 1u << 30), bytes_);
}

TEST_F(ReadFileTest, SaysWhyNot) {
  EXPECT_EQ(RefusalOf(path_ + ".not"), path_ + ".not: no such file");
  EXPECT_THAT(RefusalOf(::testing::TempDir()), HasSubstr("is a folder"));
  EXPECT_EQ(RefusalOf("/dev/zero"), "/dev/zero: is a device, allowed: a file");
}

// Opened, a pipe without a writer waits for one for ever.
TEST_F(ReadFileTest, RefusesANamedPipe) {
  const std::string pipe = folder_.File("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(RefusalOf(pipe), pipe + ": is a named pipe, allowed: a file");
}

TEST_F(ReadFileTest, ReadsAPipeOfTheShell) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(write(ends[1], "text", 4), 4);
  close(ends[1]);
  EXPECT_EQ(ReadFile("/dev/fd/" + std::to_string(ends[0])), "text");
  close(ends[0]);
}

TEST(Beside, IsRelativeToTheFolderOfTheFile) {
  EXPECT_EQ(Beside("a/b/rig.toml", "shaft.toml"), "a/b/shaft.toml");
  EXPECT_EQ(Beside("a/b/rig.toml", "../shaft.toml"), "a/shaft.toml");
  EXPECT_EQ(Beside("a/b/rig.toml", "./c/../d.toml"), "a/b/d.toml");
  EXPECT_EQ(Beside("rig.toml", "shaft.toml"), "shaft.toml");
  EXPECT_EQ(Beside("/x/rig.toml", "shaft.toml"), "/x/shaft.toml");
}

TEST(Beside, LeavesAnAbsoluteNameAlone) {
  EXPECT_EQ(Beside("a/b/rig.toml", "/data/shaft.toml"), "/data/shaft.toml");
}

}  // namespace
}  // namespace ambrig
