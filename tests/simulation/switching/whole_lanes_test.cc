/// Registers of eight doubles and pairs of four give the same bits, through the whole engine.
#include "actuators/magnetics/whole_lane_vector.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

/// Past the fault, the detection and the change of the currents.
RunResult RunOf(bool whole) {
  const std::string library = AMBRIG_SOURCE_DIR "/scenarios/library/";
  const RigParameters rig = ReadRig(library + "rigs/reference.toml");
  Scenario s = ReadScenario(library + "coil_a3_opens_1500rpm.toml", rig);
  s.duration = s.faults.front().time + 0.02;
  const bool before = whole_lanes;
  whole_lanes = whole;
  RunResult result = Simulate(rig, s, {});
  whole_lanes = before;
  return result;
}

TEST(WholeLanes, SameBits) {
  if (!HasWholeLanes()) GTEST_SKIP() << "no 512-bit registers here";
  const RunResult of_whole = RunOf(true), of_halves = RunOf(false);
  const Record &whole = of_whole.record, &halves = of_halves.record;
  const auto redistributed = [](const RunResult& r) {
    return std::any_of(r.events.begin(), r.events.end(),
                       [](const RunEvent& e) { return e.kind == "redistributed"; });
  };
  EXPECT_TRUE(redistributed(of_whole) && redistributed(of_halves));
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
