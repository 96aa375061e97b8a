// Records that the page looks at are kept in single precision, the last ones, and read again when
// their file changes.
#include "workbench/record_shelf.h"

#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "core/record/hdf5.h"
#include "tests/workbench/bench_folder.h"

namespace ambrig::workbench {
namespace {

class Shelf : public BenchFolder {
 protected:
  /// A record of two channels and `rows` rows, 8 bytes a row in memory.
  std::string Written(const std::string& name, std::size_t rows, double first) {
    Record r{.rate = 1000, .start = 0.5};
    r.channels = {{.name = "A.x", .unit = "m", .samples = std::vector<double>(rows, first)},
                  {.name = "A.y", .unit = "m", .samples = std::vector<double>(rows, 2 * first)}};
    const std::string path = (base_ / "served" / name).string();
    WriteHdf5(r, path);
    return path;
  }
};

TEST_F(Shelf, KeepsWhatTheFileHolds) {
  RecordShelf shelf;
  KeptRecord& r = shelf.Get(Written("a.h5", 100, 1e-6), "");
  EXPECT_EQ(r.rows, 100U);
  EXPECT_EQ(r.rate, 1000);
  EXPECT_EQ(r.start, 0.5);
  ASSERT_NE(r.Find("A.y"), nullptr);
  EXPECT_EQ(r.Find("A.y")->unit, "m");
  EXPECT_THAT(r.Find("A.y")->samples, ::testing::Each(2e-6F));
  EXPECT_EQ(r.Find("A.z"), nullptr);
  EXPECT_THROW(shelf.Get((base_ / "served" / "none.h5").string(), ""), InputError);
}

TEST_F(Shelf, DropsTheRecordsThatWereLookedAtLongestAgo) {
  RecordShelf shelf(2000);  // bytes: two records of 100 rows
  const std::string a = Written("a.h5", 100, 1), b = Written("b.h5", 100, 2),
                    c = Written("c.h5", 100, 3);
  shelf.Get(a, "");
  const KeptRecord* second = &shelf.Get(b, "");
  EXPECT_EQ(shelf.count(), 2U);
  shelf.Get(a, "");
  shelf.Get(b, "");
  shelf.Get(c, "");
  EXPECT_EQ(shelf.count(), 2U);
  EXPECT_EQ(&shelf.Get(b, ""), second) << "b was looked at later than a and is still there";
  shelf.Get(Written("large.h5", 1000, 4), "");  // larger than the limit: alone
  EXPECT_EQ(shelf.count(), 1U);
}

TEST_F(Shelf, KeepsNoMoreThanTwelve) {
  RecordShelf shelf;
  for (int k = 0; k < 15; ++k) shelf.Get(Written("r" + std::to_string(k) + ".h5", 10, k), "");
  EXPECT_EQ(shelf.count(), 12U);
}

TEST_F(Shelf, AFileThatChangedIsReadAgain) {
  RecordShelf shelf;
  const std::string path = Written("a.h5", 100, 1);
  EXPECT_EQ(shelf.Get(path, "").Find("A.x")->samples[0], 1);
  Written("a.h5", 120, 7);
  EXPECT_EQ(shelf.Get(path, "").Find("A.x")->samples[0], 7);
}

}  // namespace
}  // namespace ambrig::workbench
