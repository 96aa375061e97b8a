// The model beside measurements whose error is written down.
#include "discovery/decision/compare.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

const RecordComparison& Of(const Comparison& c, const std::string& data) {
  for (const RecordComparison& r : c.records)
    if (r.data == data) return r;
  throw std::runtime_error("no record " + data);
}

const ChannelError& Of(const RecordComparison& r, const std::string& channel) {
  for (const ChannelError& e : r.channels)
    if (e.channel == channel) return e;
  throw std::runtime_error("no channel " + channel);
}

// An offset of 3 µm over a noise of 0.2 µm: 15 floors, the same in all rows of one channel.
TEST(Compare, NamesTheChannelAndTheRecordThatAreOff) {
  const Case data = MeasuredCase({{2e-5, 1e-5}, {-4e-5, 3e-5, 1, 3e-6}, {5e-5, -2e-5}});
  CaseModel model(data);
  std::vector<std::string> seen;
  const Comparison c = Compare(model, Hypothesis::Base(data.rig), false,
                               [&](double, const std::string& text) { seen.push_back(text); });
  ASSERT_EQ(c.records.size(), 3u);
  const ChannelError& off = Of(Of(c, "record-2.h5"), "A.x");
  EXPECT_NEAR(off.noise, 2e-7, 4e-8);
  EXPECT_NEAR(off.rms_error, 3e-6, 3e-7);
  EXPECT_NEAR(off.ratio, off.rms_error / off.noise, 1e-9);
  EXPECT_GT(off.whiteness, 0.9);  // an offset is the same in neighbouring rows
  for (const char* channel : {"A.y", "B.x", "B.y"}) {
    const ChannelError& fine = Of(Of(c, "record-2.h5"), channel);
    EXPECT_NEAR(fine.ratio, 1, 0.25) << channel;
    EXPECT_LT(std::abs(fine.whiteness), 0.2) << channel;
  }
  EXPECT_TRUE(Of(c, "record-3.h5").validate);
  EXPECT_NEAR(Of(c, "record-1.h5").ratio, 1, 0.15);
  EXPECT_GT(c.ratio_fit, 3);
  EXPECT_NEAR(c.ratio_validate, 1, 0.15);
  double square = 0;
  for (const RecordComparison& r : c.records) square += r.ratio * r.ratio;
  EXPECT_NEAR(c.ratio, std::sqrt(square / 3), 1e-6);  // all channels have as many rows
  ASSERT_FALSE(c.words.empty());
  EXPECT_THAT(c.words.back(), HasSubstr("A.x in record-2.h5 (place 2)"));
  EXPECT_EQ(c.residual.size(), model.size());
  EXPECT_THAT(seen, ::testing::Contains("noise floor"));
  EXPECT_THAT(seen, ::testing::Contains("blocks of record-3.h5"));
}

TEST(Compare, AgreementIsSaidInOneLine) {
  const Case data = MeasuredCase({{2e-5, 1e-5}, {-4e-5, 3e-5}, {5e-5, -2e-5}});
  CaseModel model(data);
  const Comparison c = Compare(model, Hypothesis::Base(data.rig), false);
  EXPECT_TRUE(c.data.empty());
  EXPECT_NEAR(c.ratio, 1, 0.1);
  ASSERT_FALSE(c.words.empty());
  EXPECT_EQ(c.words.back(), "model and measurement agree within the noise everywhere");
}

}  // namespace
}  // namespace ambrig
