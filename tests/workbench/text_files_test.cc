// Writing from the page: only what was seen is replaced, every step can be undone, a mended case is
// read.
#include "workbench/text_files.h"

#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "tests/workbench/bench_folder.h"

namespace ambrig::workbench {
namespace {

using ::testing::HasSubstr;

const std::string kCase =
    "# mine\nrig = \"rig.toml\"\n\n[[record]]\nscenario = \"s.toml\"\ndata = \"x/one.h5\"  # "
    "first\n\n"
    "[[record]]\nscenario = \"s.toml\"\ndata = \"two.h5\"\n[record.channels]\n\"A.x\" = \"pos\"\n";

class TextEdits : public BenchFolder {
 protected:
  void SetUp() override {
    BenchFolder::SetUp();
    Write("served/case.toml", kCase);
  }
};

TEST_F(TextEdits, ReplaceOnlyWhatWasSeen) {
  const ServedFolder folder(served());
  TextFiles files(folder);
  EXPECT_THROW(files.Replace("a.toml", "x = 2\n", "0000000000000000"), Conflict);
  EXPECT_THROW(files.Replace("a.toml", "x = 2\n", ""), Conflict);  // it is not new
  EXPECT_EQ(Text("served/a.toml"), "x = 1\n");
  files.Replace("a.toml", "x = 2\n", HashText("x = 1\n"));
  EXPECT_EQ(Text("served/a.toml"), "x = 2\n");
  files.Replace("new.toml", "y = 1\n", "");
  EXPECT_EQ(Text("served/new.toml"), "y = 1\n");
  EXPECT_THROW(files.Replace("sub/b.csv", "t\n", HashText("t,x\n0,1\n1,2\n")),
               InputError);  // data stay
}

TEST_F(TextEdits, AreUndoneUnlessChangedSince) {
  const ServedFolder folder(served());
  int changed = 0, made = 0;
  {
    TextFiles files(folder);
    changed = files.Replace("a.toml", "x = 2\n", HashText("x = 1\n"));
    made = files.Replace("new.toml", "y = 1\n", "");
  }
  TextFiles files(folder);  // another server later
  files.Undo(changed);
  EXPECT_EQ(Text("served/a.toml"), "x = 1\n");
  files.Undo(made);
  EXPECT_FALSE(std::filesystem::exists(base_ / "served" / "new.toml"));
  const int again = files.Replace("a.toml", "x = 3\n", HashText("x = 1\n"));
  EXPECT_GT(again, made);  // numbers are not used twice
  Write("served/a.toml", "x = 4\n");
  EXPECT_THROW(files.Undo(again), Conflict);
  EXPECT_EQ(Text("served/a.toml"), "x = 4\n");
  EXPECT_THROW(files.Undo(99), InputError);
}

TEST_F(TextEdits, WhatIsTakenAwayCanBePutBack) {
  const ServedFolder folder(served());
  TextFiles files(folder);
  const std::string old = folder.Read("case.toml", 1 << 20);
  EXPECT_THROW(files.Remove("case.toml", "0123456789abcdef"), Conflict);
  EXPECT_THROW(files.Remove("sub/b.csv", HashText("t,x\n0,1\n1,2\n")), InputError);  // a record
  const int step = files.Remove("case.toml", HashText(old));
  EXPECT_FALSE(folder.Has("case.toml"));
  files.Undo(step);
  EXPECT_EQ(Text("served/case.toml"), old);
  EXPECT_THROW(files.Undo(step), Conflict);
}

TEST_F(TextEdits, WhatWasAddedIsTakenAwayUnlessItChanged) {
  const ServedFolder folder(served());
  TextFiles files(folder);
  const int step = files.NoteAdded("sub/b.csv");
  Write("served/sub/b.csv", "another\n");
  EXPECT_THROW(files.Undo(step), Conflict);
  const int again = files.NoteAdded("sub/b.csv");
  files.Undo(again);
  EXPECT_FALSE(folder.Has("sub/b.csv"));
  EXPECT_EQ(Text("served/.ambrig/trash/" + std::to_string(again) + ".file"), "another\n");
}

TEST_F(TextEdits, MendWritesTheLineUnderItsRecord) {
  const ServedFolder folder(served());
  TextFiles files(folder);
  const auto done =
      files.Mend("case.toml", "practice/x/one.h5", "channels.\"A.i3\" = { unit = \"mA\" }");
  EXPECT_EQ(done["line"], 7);
  std::string wanted = kCase;
  wanted.insert(wanted.find("# first\n") + 8, "channels.\"A.i3\" = { unit = \"mA\" }\n");
  EXPECT_EQ(Text("served/case.toml"), wanted);
  files.Undo(done["step"]);
  EXPECT_EQ(Text("served/case.toml"), kCase);
}

TEST_F(TextEdits, AMendThatContradictsTheRecordIsRefused) {
  int line = 0;
  const auto refusal = [&](const std::string& data, const std::string& mend) {
    try {
      MendedCase(kCase, "case.toml", data, mend, &line);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("two.h5", "channels.\"A.i3\" = { unit = \"mA\" }"), HasSubstr("by hand"));
  EXPECT_THAT(refusal("three.h5", "time_offset = 1"), HasSubstr("no record with data"));
  EXPECT_THAT(refusal("two.h5", "a = 1\n[other]"), HasSubstr("one line"));
  EXPECT_EQ(refusal("two.h5", "time_offset = 0.1"), "");
  EXPECT_EQ(line, 11);
}

}  // namespace
}  // namespace ambrig::workbench
