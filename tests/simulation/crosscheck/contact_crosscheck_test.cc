/// Does it drop? The library's scenarios with contact by both witnesses, and the figures of a drop
/// on paths that are known.
#include "simulation/crosscheck/contact_crosscheck.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "tests/rig/exact_coils.h"

namespace ambrig {
namespace {

constexpr double kClearance = 2e-4;  // [m] of the reference rig

ContactCrosscheck Library(const std::string& name) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/" + name + ".toml";
  // A code of the ADC that the two read differently grows with what follows; exact edges keep codes
  // apart longer.
  const RigParameters rig = WithExactCoils(ReadRig(RigOfScenario(file)));
  CrosscheckOptions options;
  options.other_noise = false;
  return CrosscheckContact(rig, ReadScenario(file, rig), options);
}

class Drop : public ::testing::TestWithParam<const char*> {};

// Until bouncing has made much of little: verdict, first touch, first rebound, and a common path.
TEST_P(Drop, BothWitnessesSeeTheSameFallAndTheSameVerdict) {
  const ContactCrosscheck w = Library(GetParam());
  EXPECT_TRUE(w.contact());
  EXPECT_TRUE(w.verdicts_agree());
  EXPECT_TRUE(w.model.figures.drop);
  EXPECT_EQ(w.model.figures.first, w.ode.figures.first);
  // Semi-implicit Euler falls g h t/2 deeper: half of its far step, 2.5 us, early.
  EXPECT_NEAR(w.ode.figures.touchdown_time, w.model.figures.touchdown_time - 2.5e-6, 1.5e-6);
  EXPECT_NEAR(w.ode.figures.rebound, w.model.figures.rebound, 5e-3 * kClearance);
  EXPECT_GT(w.parted_ode, w.model.figures.touchdown_time + 0.03) << "common for several impacts";
  EXPECT_EQ(w.ode_warnings, 0);
}

INSTANTIATE_TEST_SUITE_P(ContactCrosscheck, Drop,
                         ::testing::Values("drop_at_0rpm", "drop_at_1500rpm", "drop_at_12000rpm",
                                           "drop_at_60000rpm"));

TEST(ContactCrosscheck, WhirlIsBackwardAtRollingSpeedByBoth) {
  const ContactCrosscheck w = Library("drop_at_12000rpm");
  EXPECT_EQ(w.model.figures.whirl, ContactWhirl::kBackward);
  EXPECT_EQ(w.ode.figures.whirl, ContactWhirl::kBackward);
  // The journal rolls in the race: centre speed Omega R, over Omega c = 150; overshoot on the way.
  for (const DropFigures& f : {w.model.figures, w.ode.figures}) {
    EXPECT_GT(f.severity, 0.030 / kClearance);
    EXPECT_LT(f.severity, 1.1 * 0.030 / kClearance);
  }
  EXPECT_NEAR(w.ode.figures.peak_orbit, w.model.figures.peak_orbit,
              5e-3 * w.model.figures.peak_orbit);
}

struct Held {
  const char* name;
  bool touchdown, drop;
  double peak;  // [m] tolerance
};

void PrintTo(const Held& c, std::ostream* out) { *out << c.name; }
class HeldOrPulled : public ::testing::TestWithParam<Held> {};

// With the magnets' help the paths stay together to the end: every figure can be compared.
TEST_P(HeldOrPulled, BothWitnessesAgreeThroughout) {
  const Held& c = GetParam();
  const ContactCrosscheck w = Library(c.name);
  const DropFigures &a = w.model.figures, &b = w.ode.figures;
  EXPECT_TRUE(w.contact());
  EXPECT_EQ(a.touchdown, c.touchdown);
  EXPECT_EQ(b.touchdown, c.touchdown);
  EXPECT_EQ(a.drop, c.drop);
  EXPECT_EQ(b.drop, c.drop);
  EXPECT_EQ(a.whirl, b.whirl);
  EXPECT_EQ(a.first, b.first);
  EXPECT_NEAR(a.touchdown_time, b.touchdown_time, 4e-5);  // one switching period
  EXPECT_NEAR(a.rebound, b.rebound, 5e-3 * kClearance);
  EXPECT_NEAR(a.peak_orbit, b.peak_orbit, c.peak);
  EXPECT_NEAR(a.fall_severity, b.fall_severity, 5e-3 * a.fall_severity);
}

INSTANTIATE_TEST_SUITE_P(ContactCrosscheck, HeldOrPulled,
                         ::testing::Values(Held{"fault_at_sixty_percent_orbit", true, false, 1e-7},
                                           Held{"lift_off", false, false, 1e-7},
                                           Held{"sensor_loss", true, true, 1e-7},
                                           Held{"switch_stuck_on", true, true, 5e-6}));

// base_model.md section 8: in contact at the end of the run. A rotor without magnets that is in the
// air of a bounce at the last instant has dropped all the same.
TEST(ContactCrosscheck, ABouncingRotorHasDroppedWhateverTheNoise) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/drop_at_0rpm.toml";
  const RigParameters rig = ReadRig(RigOfScenario(file));
  Scenario scenario = ReadScenario(file, rig);
  scenario.duration = 0.2;
  int in_the_air = 0;
  for (scenario.seed = 1; scenario.seed <= 8; ++scenario.seed) {
    const RunResult run = Simulate(rig, scenario, {});
    EXPECT_TRUE(run.drop) << "seed " << scenario.seed;
    in_the_air += run.events.back().kind == "lift_off" ? 1 : 0;
  }
  EXPECT_GT(in_the_air, 0) << "no run ended in the air: the case is not tested";
}

TEST(ContactCrosscheck, RefusesWhatDoesNotMove) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/lift_off.toml";
  const RigParameters rig = ReadRig(RigOfScenario(file));
  Scenario scenario = ReadScenario(file, rig);
  scenario.start = StartState::kClamped;
  EXPECT_THROW(CrosscheckContact(rig, scenario), InputError);
}

TEST(ContactCrosscheck, RefusesAFlexibleRotor) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/lift_off.toml";
  RigParameters rig = ReadRig(RigOfScenario(file));
  BendingMode mode;
  mode.omega = 2000;
  mode.shape = {{-0.2, 0.3}, {0.2, 0.3}};
  rig.modes.push_back(mode);
  EXPECT_THROW(CrosscheckContact(rig, ReadScenario(file, rig)), InputError);
}

/// A path: falls to the bottom at 1 m/s, springs back by 30 um, then whirls backward twice.
TEST(DropFigures, AreThoseOfAKnownPath) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/lift_off.toml";
  const RigParameters rig = ReadRig(RigOfScenario(file));
  RunResult run;
  run.record.rate = 1e5;
  std::vector<double> ax, ay;
  for (int k = 0; k <= 21; ++k) ay.push_back(-1e-5 * k), ax.push_back(0);  // to 210 um
  for (double r : {2.0e-4, 1.8e-4, 1.7e-4, 1.9e-4, 2.05e-4}) ay.push_back(-r), ax.push_back(0);
  constexpr int kRound = 400;
  for (int k = 1; k <= 2 * kRound; ++k) {
    const double angle = -kPi / 2 - 2 * kPi * k / kRound;
    ax.push_back(2.05e-4 * std::cos(angle));
    ay.push_back(2.05e-4 * std::sin(angle));
  }
  const std::vector<double> zero(ax.size(), 0.0), speed(ax.size(), 100.0);
  run.record.channels = {{"A.r.x", "m", ax},
                         {"A.r.y", "m", ay},
                         {"B.r.x", "m", zero},
                         {"B.r.y", "m", zero},
                         {"omega", "rad/s", speed}};
  run.touchdown = run.drop = true;
  const DropPaths paths = CentrePaths(rig, run.record);
  const DropFigures f = MakeDropFigures(rig, run, paths);
  EXPECT_EQ(f.first, "A");
  EXPECT_NEAR(f.touchdown_time, 2e-4, 1e-12);
  EXPECT_NEAR(f.rebound, 3e-5, 1e-12);
  EXPECT_NEAR(f.peak_orbit, 2.1e-4, 1e-12);
  EXPECT_NEAR(f.turns, -2, 1e-9);
  EXPECT_EQ(f.whirl, ContactWhirl::kBackward);
  // Central differences: fastest from 170 um over 190 to 205 um, 35 um in two rows.
  EXPECT_NEAR(f.severity, 35e-6 * 1e5 / 2 / (100 * kClearance), 1e-9);
  EXPECT_NEAR(f.fall_severity / f.severity, 100 * kClearance / std::sqrt(2 * 9.81 * kClearance),
              1e-9);
  ASSERT_EQ(f.rest.size(), 2u);
  EXPECT_EQ(f.rest[1][0], 0);
  std::vector<double> reversed(speed.size(), -100.0);
  DropPaths other = paths;
  other.Omega = reversed;
  EXPECT_EQ(MakeDropFigures(rig, run, other).whirl, ContactWhirl::kForward);
  EXPECT_EQ(PartingTime(paths, other, 0.05), -1);
  other.bearings[1].x[50] = 1.1e-5;
  EXPECT_NEAR(PartingTime(paths, other, 0.05), 50e-5, 1e-12);
}

}  // namespace
}  // namespace ambrig
