// What fault tolerance concludes takes its computing time before it acts.
#include <gtest/gtest.h>

#include "simulation/simulate.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

RunResult OpenedWithComputingTime(const std::string& seconds) {
  const RigParameters rig =
      RigWith("kind = \"pid\"\n" + kPidGains + "[detection]\ncomputing_time = " + seconds + "\n");
  return Simulate(
      rig,
      ReadScenarioText("name = \"t\"\nduration = 0.05\nrecord_rate = 25000.0\n[[fault]]\n"
                       "time = 0.02\ntarget = \"A.coil3\"\nkind = \"open\"\n",
                       "t.toml", rig),
      {});
}

double InstantOfFirst(const RunResult& r, const std::string& kind) {
  for (const RunEvent& e : r.events)
    if (e.kind == kind) return e.t;
  return -1;
}

/// Row at which the set-point of a neighbour first jumps [s].
double JumpOfTheNeighbour(const RunResult& r) {
  const Channel* s = r.record.Find("A.s2");
  EXPECT_NE(s, nullptr);
  for (std::size_t k = 1; s && k < s->samples.size(); ++k)
    if (r.record.TimeAt(k) > 0.02 && std::abs(s->samples[k] - s->samples[k - 1]) > 0.3)
      return r.record.TimeAt(k);
  return -1;
}

TEST(ComputingTime, DelaysTheActionsByWholePeriodsAndNotTheDetection) {
  constexpr double T = 40e-6;
  const RunResult at_once = OpenedWithComputingTime("0.0");
  ASSERT_GT(InstantOfFirst(at_once, "redistributed"), 0.02);
  for (const auto& [seconds, periods] : {std::pair{"4.0e-5", 1}, {"5.0e-5", 2}, {"2.0e-4", 5}}) {
    const RunResult later = OpenedWithComputingTime(seconds);
    EXPECT_EQ(InstantOfFirst(later, "detected"), InstantOfFirst(at_once, "detected"));
    EXPECT_NEAR(InstantOfFirst(later, "redistributed"),
                InstantOfFirst(at_once, "redistributed") + periods * T, 1e-9);
    // The controller computes every second period: it takes the new map at the next of its ticks.
    const double wait = JumpOfTheNeighbour(later) - JumpOfTheNeighbour(at_once);
    EXPECT_GE(wait, (periods - 1) * T - 1e-9) << seconds;
    EXPECT_LE(wait, (periods + 1) * T + 1e-9) << seconds;
    EXPECT_FALSE(later.touchdown);
  }
}

}  // namespace
}  // namespace ambrig
