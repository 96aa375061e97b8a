// Times that a case leaves out of a record.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/errors.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/model/case_model.h"
#include "tests/discovery/bench_case.h"

namespace ambrig {
namespace {

using testing::CaseOf;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WriteBytes;

class LeaveOut : public ::testing::Test {
 protected:
  LeaveOut() {
    WriteBytes(
        folder_.File("held.toml"),
        fmt::format("name = \"held\"\nrig = \"{}\"\nduration = 0.02\nrecord_rate = 1000.0\n"
                    "[start]\nstate = \"clamped\"\nposition = {{ A = [0, 0], B = [0, 0] }}\n",
                    testing::kSpindle));
    std::string rows = "t [s],A.x [um]\n";
    for (int k = 0; k < 20; ++k) rows += fmt::format("{:.3f},{}\n", 1e-3 * k, k % 3);
    WriteBytes(folder_.File("log.csv"), rows);
  }
  Case Read(const std::string& spans) {
    return CaseOf(
        folder_,
        "[[record]]\nscenario = \"held.toml\"\ndata = \"log.csv\"\nleave_out = " + spans + "\n");
  }
  const TemporaryFolder folder_;
};

TEST_F(LeaveOut, RowsOfTheSpansHaveNoNumber) {
  const Case c = Read("[[0.0035, 0.0075], [0.015, 0.015]]");
  const Channel* x = c.records[0].data.Find("A.x");
  ASSERT_NE(x, nullptr);
  ASSERT_EQ(x->samples.size(), 20U);
  for (std::size_t k = 0; k < 20; ++k)
    EXPECT_EQ(std::isnan(x->samples[k]), (k >= 4 && k <= 7) || k == 15) << k;
}

// 20 rows, of which the logger lost six while its clock went on: they are told until the case knows
// of them.
TEST_F(LeaveOut, RowsThatALoggerLostAreTold) {
  std::string rows = "t [s],A.x [um]\n";
  for (int k = 0; k < 26; ++k)
    if (k < 12 || k >= 18) rows += fmt::format("{:.4f},{}\n", 7e-4 * k, k % 3);
  WriteBytes(folder_.File("log.csv"), rows);
  const auto told = [](const Case& c) {
    std::vector<DataFault> out;
    CheckGaps(CaseModel(c), 0, out);
    return out;
  };
  const Case c = Read("[]");
  const Channel* x = c.records[0].data.Find("A.x");
  ASSERT_NE(x, nullptr);
  ASSERT_EQ(x->samples.size(), 26U);
  for (std::size_t k = 0; k < 26; ++k) EXPECT_EQ(std::isnan(x->samples[k]), k >= 12 && k < 18) << k;
  EXPECT_THAT(c.notes, ::testing::Contains(HasSubstr("no rows between 0.0077 s and 0.0126 s")));
  EXPECT_THAT(c.notes, ::testing::Not(::testing::Contains(HasSubstr("samples missing"))));
  const std::vector<DataFault> lost = told(c);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].fault, "lost");
  EXPECT_NEAR(lost[0].seconds, 6 * 7e-4, 1e-9);
  const std::string spans = lost[0].mend.substr(lost[0].mend.find('['));
  EXPECT_TRUE(told(Read(spans)).empty()) << lost[0].mend;
}

TEST_F(LeaveOut, ASpanHasTwoEndsInTheirOrder) {
  for (const char* spans : {"[[0.004]]", "[[0.001, 0.002, 0.003]]", "[[0.008, 0.004]]"})
    EXPECT_THAT(ErrorText<InputError>([&] { Read(spans); }),
                HasSubstr("allowed: [[from, to], ...] in s of the scenario"))
        << spans;
}

}  // namespace
}  // namespace ambrig
