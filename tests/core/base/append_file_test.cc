#include "core/base/append_file.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using testing::ErrorText;
using testing::ReadBytes;
using testing::TemporaryFolder;

TEST(AppendFile, GoesOnWhereItEnded) {
  const TemporaryFolder folder;
  AppendFile(folder.File("journal")).Append("one\n");
  AppendFile(folder.File("journal")).Append("two\n");
  EXPECT_EQ(ReadBytes(folder.File("journal")), "one\ntwo\n");
}

TEST(AppendFile, OneWriterAtATime) {
  const TemporaryFolder folder;
  const AppendFile file(folder.File("journal"));
  EXPECT_NE(ErrorText<InputError>([&] {
              AppendFile(folder.File("journal"));
            }).find("another ambrig writes there"),
            std::string::npos);
}

// Of several threads any may be heard first: each must name the cause.
TEST(AppendFile, EveryEntryAfterAFailedOneNamesTheSameReason) {
  AppendFile file("/dev/full");
  for (const char* entry : {"first", "second"})
    EXPECT_EQ(ErrorText<InputError>([&] { file.Append(entry); }),
              "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace ambrig
