#include "core/base/journal.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::ErrorText;
using testing::ReadBytes;
using testing::TemporaryFolder;
using testing::WriteBytes;

class JournalTest : public ::testing::Test {
 protected:
  std::string Path() const { return folder_.File("journal"); }
  /// The journal of the work "work 1"; what it held is in `found_` then.
  Journal Open(const std::string& header = "work 1") {
    found_.clear();
    entries_.clear();
    return {Path(),
            header,
            {[header](std::string_view text) {
               if (text != header) throw InputError("another work");
             },
             [this](const JournalEntry& e) {
               found_.emplace_back(e.text);
               entries_.push_back(e);
               return true;
             }}};
  }
  /// "one" with data that look like lines, "two" without, "three" with data again.
  void WriteThree() {
    Journal journal = Open();
    journal.Append("one", kData);
    journal.Append("two");
    journal.Append("three", "333");
  }

  const std::string kData = std::string("a\nb\tc\0d\n", 8);
  TemporaryFolder folder_;
  std::vector<std::string> found_;
  std::vector<JournalEntry> entries_;
};

TEST_F(JournalTest, HoldsWhatWasAppended) {
  WriteThree();
  const Journal journal = Open();
  EXPECT_THAT(found_, ElementsAre("one", "two", "three"));
  EXPECT_EQ(journal.damaged(), 0u);
  std::string data(kData.size(), ' ');
  ASSERT_EQ(entries_[0].bytes, kData.size());
  ASSERT_TRUE(journal.ReadData(entries_[0].offset, data.data(), data.size()));
  EXPECT_EQ(data, kData);
  EXPECT_EQ(entries_[1].bytes, 0u);
  EXPECT_EQ(entries_[2].bytes, 3u);
}

TEST_F(JournalTest, DataAreWhereAppendSays) {
  Journal journal = Open();
  journal.Append("one", "11");
  const std::size_t at = journal.Append("two", "222");
  std::string data(3, ' ');
  ASSERT_TRUE(journal.ReadData(at, data.data(), data.size()));
  EXPECT_EQ(data, "222");
}

// Cut anywhere: what was whole is found, what was cut off is one damaged entry, and the journal
// goes on behind it.
TEST_F(JournalTest, CutAnywhere) {
  WriteThree();
  const std::string all = ReadBytes(Path());
  const std::size_t header = all.find('\n') + 1;
  std::size_t most = 0;
  for (std::size_t size = 0; size < all.size(); ++size) {
    WriteBytes(Path(), all.substr(0, size));
    { Open().Append("new"); }
    const Journal journal = Open();
    ASSERT_FALSE(found_.empty()) << size;
    EXPECT_EQ(found_.back(), "new") << size;
    EXPECT_LE(journal.damaged(), 1u) << size;
    EXPECT_GE(found_.size() - 1, most) << size;
    most = found_.size() - 1;
    if (size < header) {
      EXPECT_EQ(found_.size(), 1u) << size;
    }
  }
  EXPECT_EQ(most, 3u);  // without its last newline nothing is lost
}

TEST_F(JournalTest, AChangedByteSpoilsItsEntryOnly) {
  WriteThree();
  const std::string all = ReadBytes(Path());
  const std::size_t begin = all.find("one"), end = all.find("two");
  for (std::size_t at = begin; at < end - 1; ++at) {
    std::string changed = all;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    WriteBytes(Path(), changed);
    const Journal journal = Open();
    EXPECT_THAT(found_, ElementsAre("two", "three")) << at - begin;
    EXPECT_GE(journal.damaged(), 1u) << at - begin;
  }
}

TEST_F(JournalTest, AnotherWorkAndASecondWriterAreRefused) {
  { WriteThree(); }
  EXPECT_EQ(ErrorText<InputError>([&] { Open("work 2"); }), "another work");
  const Journal journal = Open();
  EXPECT_NE(ErrorText<InputError>([&] { Open(); }).find("another ambrig writes there"),
            std::string::npos);
}

// A pipe waits for its other end for ever.
TEST_F(JournalTest, IsAFile) {
  ASSERT_EQ(mkfifo(Path().c_str(), 0600), 0);
  EXPECT_EQ(testing::ErrorText<InputError>([&] { ReadJournalFile(Path(), {}); }),
            Path() + ": cannot be read");
  EXPECT_EQ(testing::ErrorText<InputError>([&] { Journal(Path(), "header", {}); }),
            "cannot write " + Path() + ": not a regular file");
}

// A torn header is begun again; a file of somebody else's, even of one line without an end, is left
// alone.
TEST_F(JournalTest, OnlyATornHeaderIsBegunAgain) {
  for (const std::string& foreign :
       {std::string("mine"), std::string("work 2"), std::string("w o")}) {
    WriteBytes(Path(), foreign);
    EXPECT_NE(ErrorText<InputError>([&] { Open(); }).find("not an output of ambrig"),
              std::string::npos);
    EXPECT_EQ(ReadBytes(Path()), foreign);
  }
  WriteBytes(Path(), "work");
  Open();
  EXPECT_EQ(ReadBytes(Path()).substr(0, 7), "work 1\t");
}

TEST_F(JournalTest, AnEntryThatSaysNothingCounts) {
  WriteThree();
  const JournalVisitor visit{[](std::string_view) {},
                             [](const JournalEntry& e) { return e.text != "two"; }};
  EXPECT_EQ(ReadJournalFile(Path(), visit), 1u);
  EXPECT_NE(ErrorText<InputError>([&] { ReadJournalFile(folder_.File("none"), visit); }), "");
}

}  // namespace
}  // namespace ambrig
