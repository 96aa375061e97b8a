// Clamped records that begin under a current which their scenario does not state.
#include "discovery/data_gate/start_current.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::kClampedRecord;
using testing::Measured;
using testing::MeasuredBy;
using testing::RecordNamed;

std::vector<UnstatedStart> StartsOf(CaseModel& model) {
  const NoiseFloor floor = FindFloor(model, Hypothesis::Base(model.data().rig));
  return UnstatedStartsOf(model, floor.clean);
}

TEST(StartCurrent, WhatNothingStatesIsLeftOut) {
  Case c = Measured();
  const std::size_t record = RecordNamed(c, kClampedRecord);
  auto& stated = c.records[record].scenario.start_current;
  stated = {{"A.coil1", 2.5}};
  c = MeasuredBy(Hypothesis::Base(c.rig), c);
  {
    CaseModel model(c);
    EXPECT_TRUE(StartsOf(model).empty());  // stated
  }
  c.records[record].scenario.start_current.clear();
  CaseModel model(c);
  const std::vector<UnstatedStart> starts = StartsOf(model);
  ASSERT_EQ(starts.size(), 1U);
  EXPECT_EQ(starts[0].record, record);
  EXPECT_EQ(starts[0].channel, "A.i1");
  EXPECT_GT(starts[0].measured, starts[0].predicted + 0.5);
  EXPECT_GT(starts[0].settled, 2e-3);
  EXPECT_LT(starts[0].settled, 0.1);
  const std::vector<SampleSpan> spans = SpansOf(model, starts);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].first, 0U);
  EXPECT_THAT(StartRemarks(c, starts)[0], ::testing::HasSubstr("A.i1 begins at"));
}

// A logger whose first row holds the settled reading from before the start.
TEST(StartCurrent, TheFirstRowMayBeOfThePeriodBefore) {
  Case c = Measured();
  const std::size_t record = RecordNamed(c, kClampedRecord);
  const Case settled = MeasuredBy(Hypothesis::Base(c.rig), c);
  c.records[record].scenario.start_current = {{"A.coil1", 2.5}};
  c = MeasuredBy(Hypothesis::Base(c.rig), c);
  c.records[record].scenario.start_current.clear();
  auto& channels = c.records[record].data.channels;
  std::ranges::find(channels, "A.i1", &Channel::name)->samples[0] =
      settled.records[record].data.Find("A.i1")->samples[0];
  CaseModel model(c);
  const std::vector<UnstatedStart> starts = StartsOf(model);
  ASSERT_EQ(starts.size(), 1U);
  EXPECT_EQ(starts[0].channel, "A.i1");
  EXPECT_GT(starts[0].settled, 5 * c.rig.amplifier.kp / c.rig.amplifier.ki);
}

TEST(StartCurrent, ARecordThatBeginsAsCommandedIsWhole) {
  const Case c = Measured();
  CaseModel model(c);
  EXPECT_TRUE(StartsOf(model).empty());
}

}  // namespace
}  // namespace ambrig
