// Several records in one file: each comes back as it was, with its own rate; a missing group is
// said.
#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "core/record/hdf5.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::ambrig::testing::TemporaryFolder;
using ::testing::HasSubstr;

class Hdf5Groups : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

Record Small(double rate, const std::string& channel, std::vector<double> samples) {
  Record r;
  r.rate = rate;
  r.start = 0.5;
  r.channels = {{channel, "m", std::move(samples)}};
  return r;
}

TEST_F(Hdf5Groups, ComeBackAsTheyWere) {
  const std::string file = folder_.File("groups.h5");
  WriteHdf5Groups({{"one", Small(100, "A.x", {1, 2, 3})}, {"two", Small(7, "B.y", {4, 5})}},
                  {{"made_by", "test"}}, file);
  const Record one = ReadHdf5Group(file, "one"), two = ReadHdf5Group(file, "two");
  EXPECT_EQ(one.rate, 100);
  EXPECT_EQ(one.start, 0.5);
  ASSERT_TRUE(one.Find("A.x"));
  EXPECT_EQ(one.Find("A.x")->samples, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(two.rate, 7);
  EXPECT_EQ(two.Find("B.y")->unit, "m");
}

TEST_F(Hdf5Groups, WrongNamesAreRefused) {
  const std::string file = folder_.File("groups.h5");
  for (const char* name : {"", "a/b", "a.b"})
    EXPECT_THROW(WriteHdf5Groups({{name, Small(1, "x", {1, 2})}}, {}, file), InputError) << name;
  WriteHdf5Groups({{"one", Small(100, "A.x", {1, 2, 3})}}, {}, file);
  try {
    ReadHdf5Group(file, "three");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no group three"));
  }
}

}  // namespace
}  // namespace ambrig
