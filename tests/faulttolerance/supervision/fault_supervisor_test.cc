// Detection and redistribution in whole runs: every class of fault, one or several.
#include "tests/faulttolerance/supervision/supervised_runs.h"

namespace ambrig {
namespace {

struct Case {
  const char *kind, *parameters;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.kind << " " << c.parameters; }
class EveryClass : public ::testing::TestWithParam<Case> {};

// Ten periods, 0.4 ms, for the class; the alarm well before. The run ends 1.1 ms after the fault:
// nothing is redistributed, and a switch that stays on pulls the shaft to the stator soon after.
TEST_P(EveryClass, IsNamedWithinTenPeriodsOnAnyCoilOfADrawnRig) {
  const Case c = GetParam();
  unsigned seed = 1;
  for (const char* coil : {"A.coil3", "A.coil6", "B.coil1", "B.coil8", "Z.coil2"}) {
    const double t = 0.01 + 7.7e-6 * seed;
    const Outcome o = Simulated(Spin(0.0112, 157, seed) + FaultTable(t, coil, c.kind, c.parameters),
                                Drawn(seed, 1), false);
    ++seed;
    EXPECT_EQ(o.Class(coil), c.kind) << coil;
    EXPECT_LT(o.result.metrics.detection_delay, 0.2e-3) << coil;
    EXPECT_LT(o.When("classified") - t, 0.4e-3) << coil;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << coil;
    if (std::string(c.kind) == "partial-short") {
      const double s = o.scenario.faults[0].Get("fraction", 0);
      EXPECT_NEAR(o.Fraction(coil), s, 0.03) << coil;
    }
  }
}

// Any detector of the catalogue can drive a run: its alarm, the common examination's class.
TEST(FaultSupervisor, EveryDetectorOfTheCatalogueBringsTheRigThroughAnOpenCoil) {
  for (const CoilDetectorKind& k : CoilDetectorKinds()) {
    if (!k.make) continue;  // commissioned ones need their file
    RigParameters rig = Rig();
    rig.detection.kind = k.name;
    const Outcome o = Simulated(Spin(0.05, 157, 1) + FaultTable(0.02, "A.coil3", "open"), rig);
    EXPECT_EQ(o.Class("A.coil3"), "open") << k.name;
    EXPECT_LT(o.result.metrics.detection_delay, 2.5e-3) << k.name;
    EXPECT_EQ(o.When("redistributed"), o.When("classified")) << k.name;
    EXPECT_FALSE(o.result.drop) << k.name;
    EXPECT_LT(o.result.metrics.max_orbit.at("A"), 60e-6) << k.name;
  }
}

// Two windings share a core: the fault of one shows in both.
TEST_P(EveryClass, OfTwoWindingsOnOneCoreTheRightOneIsNamed) {
  const Case c = GetParam();
  for (unsigned seed = 1; seed <= 16; ++seed) {
    const std::string coil = fmt::format("Z.coil{}", 1 + seed % 4);
    const double t = 0.01 + 7.7e-6 * seed;
    const Outcome o = Simulated(Spin(0.0112, 157, seed) + FaultTable(t, coil, c.kind, c.parameters),
                                Drawn(seed, 1), false);
    EXPECT_EQ(o.Class(coil), c.kind) << coil << " seed " << seed;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << coil << " seed " << seed;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Faults, EveryClass,
    ::testing::Values(Case{"open", ""}, Case{"amplifier-off", ""},
                      Case{"partial-short", "fraction = 0.5"},
                      Case{"partial-short", "fraction = 0.1"},
                      Case{"partial-short", "fraction = 0.3, short_resistance = 0.05"},
                      Case{"switch-stuck-on", ""}, Case{"current-sensor", "gain = 0.8"},
                      Case{"current-sensor", "offset = 0.5"},
                      Case{"current-sensor", "stuck = true"}));

// Each half-short alone is easy; two at once each spoil the flux that the other one is judged by.
TEST(FaultSupervisor, HalfShortsTogetherAreNamedAndTheRotorStays) {
  for (const std::vector<int>& set :
       {std::vector<int>{2, 3}, {1, 4}, {1, 2, 3}, {1, 2, 3, 4, 5, 6, 7, 8}}) {
    std::string s = Spin(0.06, 157, 3);
    for (int coil : set)
      s += FaultTable(0.02, fmt::format("A.coil{}", coil), "partial-short", "fraction = 0.5");
    const Outcome o = Simulated(s, Rig());
    for (int coil : set) {
      const std::string target = fmt::format("A.coil{}", coil);
      EXPECT_EQ(o.Class(target), "partial-short") << target << " of " << set.size();
      EXPECT_NEAR(o.Fraction(target), 0.5, 0.03) << target << " of " << set.size();
    }
    EXPECT_EQ(o.result.metrics.false_alarms, 0);
    EXPECT_LT(o.result.metrics.redistribution_delay, 0.3e-3);
    EXPECT_LT(o.result.metrics.max_orbit.at("A"), 40e-6) << set.size();
  }
}

// The second fault comes while the first is examined, or in the pause after it.
TEST(FaultSupervisor, ShortsWithinAHalfMillisecondAreNamed) {
  for (double gap : {60e-6, 120e-6, 180e-6, 260e-6, 400e-6}) {
    const Outcome o = Simulated(
        Spin(0.03, 157, 5) + FaultTable(0.02, "A.coil3", "partial-short", "fraction = 0.5") +
            FaultTable(0.02 + gap, "A.coil6", "partial-short", "fraction = 0.2"),
        Rig());
    EXPECT_EQ(o.Class("A.coil3"), "partial-short") << gap;
    EXPECT_EQ(o.Class("A.coil6"), "partial-short") << gap;
    EXPECT_NEAR(o.Fraction("A.coil3"), 0.5, 0.05) << gap;
    EXPECT_NEAR(o.Fraction("A.coil6"), 0.2, 0.05) << gap;
  }
}

}  // namespace
}  // namespace ambrig
