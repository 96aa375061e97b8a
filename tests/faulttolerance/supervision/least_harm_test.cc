// Actions that would do more harm than the fault: runs of example rigs, whose plants have effects,
// tolerances and closed loops of shorted turns that no detector's model has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/record/channels.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

RigParameters Example(const std::string& file) {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + file);
}

RunResult RunOf(const RigParameters& rig, const std::string& text) {
  return Simulate(rig, ReadScenarioText("name = \"harm\"\n" + text, "s.toml", rig), {});
}

/// Coils that were switched off or taken to have lost turns.
std::set<std::string> GivenUp(const RunResult& r) {
  std::set<std::string> coils;
  for (const CoilAction& a : r.actions)
    if (a.action == "disable" || a.action == "derate") coils.insert(a.coil);
  return coils;
}

// Shorted turns that close through a resistance keep the ripple out of their pole: they look like a
// larger loss of turns than that of the ampere-turns, and the potential of the rotor is taken for
// another one. That is in the linkages of all coils, with the sense of their windings.
TEST(LeastHarm, AClosedLoopOfTurnsIsNotBlamedOnHealthyCoils) {
  for (const char* loop :
       {"fraction = 0.1, short_resistance = 0.05", "fraction = 0.3, short_resistance = 0.05",
        "fraction = 0.02, short_resistance = 0.01"}) {
    const RunResult r = RunOf(Example("heavy_compressor/rig.toml"),
                              "duration = 0.3\nseed = 1\n[speed]\nprofile = [[0.0, 900.0]]\n"
                              "[[fault]]\ntime = 0.1\ntarget = \"A.coil3\"\nkind = "
                              "\"partial-short\"\nparameters = { " +
                                  std::string(loop) + " }\n");
    EXPECT_EQ(GivenUp(r), std::set<std::string>{"A.coil3"}) << loop;
    EXPECT_FALSE(r.touchdown) << loop;
  }
}

// A reading that is a fifth too small makes c = -0.2: a probe current has to find less than half of
// that before the coil is taken for healthy.
TEST(LeastHarm, ACoilWithAFalseCurrentSensorIsNotPutBack) {
  for (const double gain : {0.8, 0.75}) {
    const RunResult r = RunOf(Example("heavy_compressor/rig.toml"),
                              "duration = 0.3\nseed = 1\n[speed]\nprofile = [[0.0, 500.0]]\n"
                              "[[fault]]\ntime = 0.1\ntarget = \"A.coil3\"\nkind = "
                              "\"current-sensor\"\nparameters = { gain = " +
                                  std::to_string(gain) + " }\n");
    EXPECT_EQ(GivenUp(r), std::set<std::string>{"A.coil3"}) << gain;
    for (const CoilAction& a : r.actions) EXPECT_NE(a.action, "restore") << gain;
  }
}

// A side of a thrust bearing without turns: the other one pulls its own way, whichever sign its
// currents have.
TEST(LeastHarm, AThrustSideThatIsLeftAloneIsNotDrivenBelowZero) {
  RigParameters rig = Example("reference/rig.toml");
  rig.amplifier.quadrants = 4;
  for (const double load : {-10.0, 0.0, 10.0}) {
    const RunResult r = RunOf(
        rig, "duration = 0.2\nseed = 1\n[[load]]\nplane = \"Z\"\nforce = " + std::to_string(load) +
                 "\n[[fault]]\ntime = 0.05\ntarget = \"Z.coil1\"\nkind = \"open\"\n"
                 "[[fault]]\ntime = 0.1\ntarget = \"Z.coil2\"\nkind = \"open\"\n");
    for (int coil = 2; coil < 4; ++coil) {
      const Channel* set = Find(r.record, {ChannelKind::kSetPoint, "Z", coil});
      ASSERT_NE(set, nullptr);
      EXPECT_GE(*std::min_element(set->samples.begin(), set->samples.end()), 0) << load << coil;
    }
  }
}

// The last winding of a side whose reading is a fifth too small still pulls; a side without any
// leaves the shaft to the stop.
TEST(LeastHarm, TheLastWindingOfAThrustSideIsNotGivenUpForALittleFalseReading) {
  const RunResult r =
      RunOf(Example("heavy_compressor/rig.toml"),
            "duration = 0.3\nseed = 1\n[speed]\nprofile = [[0.0, 500.0]]\n"
            "[[fault]]\ntime = 0.1\ntarget = \"Z.coil4\"\nkind = \"open\"\n"
            "[[fault]]\ntime = 0.15\ntarget = \"Z.coil3\"\nkind = \"current-sensor\"\n"
            "parameters = { gain = 0.8 }\n");
  EXPECT_EQ(GivenUp(r), std::set<std::string>{"Z.coil4"});
  EXPECT_FALSE(r.touchdown);
}

// A loop of shorted turns in one winding of a thrust side keeps the ripple out of the flux of both:
// driven as if each had lost half of its turns, they pull with four times the force.
TEST(LeastHarm, ALoopInAThrustWindingIsNotDrivenAsHalfOfBoth) {
  const RunResult r =
      RunOf(Example("heavy_compressor/rig.toml"),
            "duration = 0.2\nseed = 1\n[speed]\nprofile = [[0.0, 500.0]]\n[[load]]\n"
            "plane = \"Z\"\nforce = 150.0\n[[fault]]\ntime = 0.1\ntarget = \"Z.coil3\"\n"
            "kind = \"partial-short\"\nparameters = { fraction = 0.2, short_resistance = 0.2 }\n");
  EXPECT_EQ(GivenUp(r), std::set<std::string>{"Z.coil3"});
  EXPECT_FALSE(r.touchdown);
}

}  // namespace
}  // namespace ambrig
