// Words for what no effect explains, from errors that are written down.
#include "discovery/decision/describe.h"

#include <gmock/gmock.h>

#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

class DescribeTest : public ::testing::Test {
 protected:
  DescribeTest() {
    for (Target& t : model_.targets()) t.floor = 2e-7;
  }
  /// An error of `ratio` floors in one channel of one record, of 1 in all others.
  Unexplained Of(std::size_t record, std::size_t channel, double ratio) {
    FitResult fit;
    fit.hypothesis = Hypothesis::Base(case_.rig);
    fit.residual.assign(model_.size(), 1);
    for (const Target& t : model_.targets())
      if (t.record == record && t.channel == channel)
        std::fill_n(fit.residual.begin() + static_cast<std::ptrdiff_t>(t.first), t.count, ratio);
    return Describe(model_, fit);
  }
  const Case case_ = MeasuredCase({{2e-5, 1e-5}, {-4e-5, 3e-5}, {5e-5, -2e-5}});
  CaseModel model_{case_};
};

TEST_F(DescribeTest, NamesBlockPlaneAxisRecordAndSize) {
  const Unexplained u = Of(1, 3, 6.5);
  EXPECT_EQ(u.where, "plane B, worst at B.y");
  EXPECT_EQ(u.block, "coil or force");  // the rotor was held
  EXPECT_THAT(u.text, HasSubstr("in record-2.h5: 6.5 times the noise at B.y"));
  EXPECT_THAT(u.text, HasSubstr("it depends most on nothing that was tried."));
  EXPECT_TRUE(u.formula.empty());  // no force can be told from a rotor that is held
}

TEST_F(DescribeTest, SmallErrorsOfAHeldRotorAreNotTheCoils) {
  const Unexplained u = Of(0, 0, 1.4);
  EXPECT_EQ(u.where, "plane A, worst at A.x");
  EXPECT_EQ(u.block, "rotor or sensor");
}

}  // namespace
}  // namespace ambrig
