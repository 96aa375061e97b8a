/// Registers of eight doubles and pairs of four give the same bits, through the whole engine.
#include "actuators/magnetics/whole_lane_vector.h"

#include <gtest/gtest.h>

#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {
namespace {

Record RunOf(bool whole) {
  const std::string library = AMBRIG_SOURCE_DIR "/scenarios/library/";
  const RigParameters rig = ReadRig(library + "rigs/reference.toml");
  Scenario s = ReadScenario(library + "coil_a3_opens_1500rpm.toml", rig);
  s.duration = 0.06;
  const bool before = whole_lanes;
  whole_lanes = whole;
  Record record = SwitchingEngine(rig, s, {}).Run().record;
  whole_lanes = before;
  return record;
}

TEST(WholeLanes, SameBits) {
  if (!HasWholeLanes()) GTEST_SKIP() << "no 512-bit registers here";
  const Record whole = RunOf(true), halves = RunOf(false);
  ASSERT_EQ(whole.channels.size(), halves.channels.size());
  std::size_t rows = 0;
  for (std::size_t c = 0; c < whole.channels.size(); ++c) {
    EXPECT_EQ(whole.channels[c].samples, halves.channels[c].samples) << whole.channels[c].name;
    rows += whole.channels[c].samples.size();
  }
  EXPECT_GT(rows, 10000U);
}

}  // namespace
}  // namespace ambrig
