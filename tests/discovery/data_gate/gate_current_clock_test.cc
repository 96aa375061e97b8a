// Currents against their own set-points: a coil that follows in one record and is late in another
// was logged late, whatever acts on the rotor.
#include <gtest/gtest.h>

#include "core/record/channels.h"
#include "discovery/data_gate/gate_checks.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::Measured;
using testing::RecordNamed;

constexpr const char* kSines = "multisine at 60 Hz";

std::vector<DataFault> CurrentClockFaults(const Case& c) {
  std::vector<DataFault> out;
  CheckCurrentClocks(CaseModel(c), Hypothesis::Base(c.rig), out);
  return out;
}

TEST(GateCurrentClock, CurrentsThatAreLateInOneRecord) {
  Case c = Measured({testing::CrossCouplingAtA(1e5)}, 0, kSines);
  EXPECT_TRUE(CurrentClockFaults(c).empty());
  CaseRecord& r = c.records[RecordNamed(c, kSines)];
  const auto rows = std::lround(2.5e-3 * r.data.rate);
  for (Channel& ch : r.data.channels)
    if (ch.name.starts_with("A.i"))
      std::copy_backward(ch.samples.begin(), ch.samples.end() - rows, ch.samples.end());
  const std::vector<DataFault> faults = CurrentClockFaults(c);
  ASSERT_EQ(faults.size(), 8U);
  for (const DataFault& f : faults) {
    EXPECT_EQ(f.fault, "lag");
    EXPECT_EQ(f.record, kSines);
    EXPECT_TRUE(f.channel.starts_with("A.i")) << f.channel;
    EXPECT_NEAR(f.seconds, 2.5e-3, 5e-4) << f.channel;
  }
}

}  // namespace
}  // namespace ambrig
