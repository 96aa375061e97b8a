#include "core/base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using testing::ErrorText;
using testing::ReadBytes;
using testing::TemporaryFolder;

std::string WriteError(const std::string& path, const std::string& content = "new") {
  return ErrorText<InputError>([&] { WriteFileAtomically(path, content); });
}

TEST(AtomicFile, ReplacesTheFile) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder.File("a"), "old");
  WriteFileAtomically(folder.File("a"), std::string("new\0text", 8));
  EXPECT_EQ(ReadBytes(folder.File("a")), std::string("new\0text", 8));
  EXPECT_THAT(folder.Names(), ElementsAre("a"));
}

TEST(AtomicFile, WithoutCommitTheOldFileStays) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder.File("a"), "old");
  {
    AtomicFile file(folder.File("a"));
    file.Write("half");
    EXPECT_EQ(ReadBytes(file.temporary()), "half");
    EXPECT_EQ(ReadBytes(folder.File("a")), "old");
  }
  EXPECT_EQ(ReadBytes(folder.File("a")), "old");
  EXPECT_THAT(folder.Names(), ElementsAre("a"));
}

TEST(AtomicFile, ReplacesTheTargetOfALinkNotTheLink) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder.File("a"), "old");
  ASSERT_EQ(symlink("a", folder.File("link").c_str()), 0);
  WriteFileAtomically(folder.File("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.File("link")));
  EXPECT_EQ(ReadBytes(folder.File("a")), "new");
}

TEST(AtomicFile, ReasonsAreNamed) {
  const TemporaryFolder folder;
  EXPECT_EQ(WriteError(folder.File("none/a")),
            "cannot write " + folder.File("none/a") + ": No such file or directory");
  EXPECT_EQ(WriteError("/proc/a"), "cannot write /proc/a: No such file or directory");
  std::filesystem::create_directory(folder.File("d"));
  EXPECT_EQ(WriteError(folder.File("d")), "cannot write " + folder.File("d") + ": Is a directory");
  EXPECT_EQ(WriteError("/dev/full"), "cannot write /dev/full: No space left on device");
  ASSERT_EQ(mkfifo(folder.File("pipe").c_str(), 0600), 0);
  EXPECT_EQ(WriteError(folder.File("pipe")),
            "cannot write " + folder.File("pipe") + ": Broken pipe");
  EXPECT_EQ(WriteError("/dev/null"), "");  // written in place, not renamed over
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(ErrorText<InputError>([] { AtomicFile file("/dev/null"); }),
            "cannot write /dev/null: not a regular file");
  if (geteuid() != 0) {  // root may write anywhere
    std::filesystem::permissions(folder.File("d"), std::filesystem::perms::owner_read);
    EXPECT_EQ(WriteError(folder.File("d/a")),
              "cannot write " + folder.File("d/a") + ": Permission denied");
  }
}

// The size limit of the process stands for a full disk: the write fails half-way.
TEST(AtomicFile, AFullDiskLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder.File("a"), "old");
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small = {1000, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string text = WriteError(folder.File("a"), std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(text, "cannot write " + folder.File("a") + ": File too large");
  EXPECT_EQ(ReadBytes(folder.File("a")), "old");
  EXPECT_THAT(folder.Names(), ElementsAre("a"));
}

}  // namespace
}  // namespace ambrig
