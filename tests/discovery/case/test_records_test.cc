// Records of the test: who sees them, and what validates beside them.
#include "discovery/case/test_records.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "tests/discovery/bench_case.h"

namespace ambrig {
namespace {

using testing::CaseOf;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WriteBytes;

class TestRecords : public ::testing::Test {
 protected:
  TestRecords() {
    WriteBytes(
        folder_.File("held.toml"),
        fmt::format("name = \"held\"\nrig = \"{}\"\nduration = 0.02\nrecord_rate = 1000.0\n"
                    "[start]\nstate = \"clamped\"\nposition = {{ A = [0, 0], B = [0, 0] }}\n",
                    testing::kSpindle));
    std::string rows = "t [s],A.x [um]\n";
    for (int k = 0; k < 20; ++k) rows += fmt::format("{:.3f},{}\n", 1e-3 * k, k % 3);
    for (int r = 0; r < 5; ++r) WriteBytes(folder_.File(fmt::format("log-{}.csv", r)), rows);
  }
  /// Records with these uses; "" states none.
  Case Read(const std::vector<std::string>& uses) {
    std::string text;
    for (std::size_t r = 0; r < uses.size(); ++r)
      text += fmt::format("[[record]]\nscenario = \"held.toml\"\ndata = \"log-{}.csv\"\n{}", r,
                          uses[r].empty() ? "" : "use = \"" + uses[r] + "\"\n");
    return CaseOf(folder_, text);
  }
  const TemporaryFolder folder_;
};

TEST_F(TestRecords, ASearchSeesTheOthersOnly) {
  const Case c = Read({"fit", "test", "validate", "test"});
  const auto seen = WithoutTestRecords(c), test = TestRecordsOf(c);
  ASSERT_TRUE(seen && test);
  ASSERT_EQ(seen->records.size(), 2U);
  EXPECT_TRUE(seen->records[1].validate);
  ASSERT_EQ(test->records.size(), 2U);
  EXPECT_EQ(test->records[1].data_file, c.records[3].data_file);
  EXPECT_TRUE(c.records[3].validate);  // no fit sees it
  EXPECT_TRUE(AnyValidates(c));
  EXPECT_FALSE(WithoutTestRecords(Read({"fit", "validate"})));
}

// Fit and test alone: the test is no validation, every third of the others is.
TEST_F(TestRecords, OneOfTheFittedValidatesBesideATest) {
  const Case c = Read({"fit", "test", "fit", "fit"});
  EXPECT_TRUE(c.records[3].validate);
  EXPECT_FALSE(c.records[3].test);
  EXPECT_THAT(c.notes, ::testing::Contains(HasSubstr(
                           "1 of 3 are reserved for validation beside the records of the test")));
}

TEST_F(TestRecords, WhereNoneCanBeSparedANoteSaysSo) {
  const Case c = Read({"fit", "test"});
  EXPECT_FALSE(AnyValidates(c));
  EXPECT_FALSE(c.records[0].validate);
  EXPECT_THAT(c.notes, ::testing::Contains(HasSubstr("what fits is not validated beside the")));
}

TEST_F(TestRecords, ARecordThatWasChosenByTestsNothing) {
  const std::string record = "[[record]]\nscenario = \"held.toml\"\ndata = \"log-0.csv\"\nuse = ";
  EXPECT_THAT(ErrorText<InputError>(
                  [&] { CaseOf(folder_, record + "\"validate\"\n" + record + "\"test\"\n"); }),
              HasSubstr("is validated and a test, allowed: a record that the search does not see"));
}

}  // namespace
}  // namespace ambrig
