// Every stator whose k_i and k_s are known (tests/actuators/magnetics/stator_oracles_test.cc), with
// the same dimensions, in a machine: it levitates, a coil breaks, the currents are redistributed,
// and the rotor stays up where the coils that are left can hold the weight; where they cannot, it
// drops.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

/// Two equal bearings. The weight takes a fifth of the linear force k_i i0 of each, kp is twice
/// k_s, kd 0.7 of critical damping.
struct OracleMachine {
  const char* stator;
  double ki, ks;  // [N/A], [N/m]
  int quadrants;
};

std::string MachineText(const OracleMachine& m) {
  const double mass = 0.4 * m.ki * 2 / 9.81, kp = 2 * m.ks;
  const double kd = 1.4 * std::sqrt(m.ks * mass / 2);
  return fmt::format(
      "gravity = [0.0, -9.81, 0.0]\n"
      "[rotor]\nkind = \"rigid\"\nmass = {:e}\ninertia_transverse = {:e}\ninertia_polar = {:e}\n"
      "journal_radius = 0.02\n"
      "[amplifier]\nmodulation = \"two-level\"\nbus_voltage = 150.0\nswitching_frequency = "
      "25000.0\n"
      "bandwidth = 800.0\nadc_samples_per_period = 18\nquadrants = {}\nadc_bits = 12\n"
      "adc_range = 15.0\ncurrent_noise = 0.003\ni_max = 8.0\n"
      "[controller]\nkind = \"pid\"\nrate = 12500.0\nkp = {:e}\nkd = {:e}\nki = {:e}\n"
      "derivative_time_constant = 1.0e-4\nf_max = {:e}\nbias_current = 2.0\n"
      "[bearings.A]\nkind = \"stator\"\n{}\nz = -0.08\nturns = 100\npole_area = 2.0e-4\n"
      "gap = 4.0e-4\nleakage_inductance = 1.0e-3\nresistance = 1.0\n"
      "sensor = {{ z = -0.08, noise = 1.0e-7 }}\n"
      "auxiliary = {{ clearance = 2.0e-4, stiffness = 1.0e7, damping = 0.5, friction = 0.15 }}\n"
      "[bearings.B]\nlike = \"A\"\nz = 0.08\nsensor = {{ z = 0.08, noise = 1.0e-7 }}\n",
      mass, 2.5e-3 * mass, 5e-4 * mass, m.quadrants, kp, kd, 10 * kp, 2 * m.ki, m.stator);
}

/// Coils of A are lost at 0.05 s of 0.2 s.
RunResult RunWithout(const RigParameters& rig, const std::vector<std::string>& lost) {
  std::string text =
      "rig = \"rig.toml\"\nduration = 0.2\nrecord_rate = 12500.0\nseed = 1\n"
      "[speed]\nprofile = [[0.0, 157.08]]\n";
  for (const std::string& coil : lost)
    text += "[[fault]]\ntime = 0.05\ntarget = \"" + coil + "\"\nkind = \"open\"\n";
  return Simulate(rig, ReadScenarioText(text, "scenario.toml", rig), {});
}

std::string ClassOf(const RunResult& r) {
  std::string last;
  for (const RunEvent& e : r.events)
    if (e.kind.ends_with("redistributed")) last = e.fault_class;
  return last;
}

double LargestOrbit(const RunResult& r) {
  double orbit = 0;
  for (const auto& [bearing, largest] : r.metrics.max_orbit) orbit = std::max(orbit, largest);
  return orbit;
}

constexpr const char* kMagnet = "bias = { mmf = 800.0, length = 4.0e-3, area = 6.0e-4 }";
const OracleMachine kPairs8{"template = \"series-pairs\"\npoles = 8", 116.0981, 628318.5, 2};
const OracleMachine kPairs8Equal{"template = \"series-pairs\"\npoles = 8\nwinding = \"NNSS\"",
                                 116.0981, 628318.5, 2};
const OracleMachine kPairs16{"template = \"series-pairs\"\npoles = 16", 227.7347, 1256637, 2};
const OracleMachine kPairs24{"template = \"series-pairs\"\npoles = 24", 340.3825, 1884956, 2};
const OracleMachine kCoresEqual{"template = \"e-core\"\nwinding = \"N\"", 62.8319, 314159, 2};
const OracleMachine kCores{"template = \"e-core\"", 125.6637, 628319, 2};
const OracleMachine kCone{"template = \"conical\"\npoles = 8\ncone_deg = 10.0", 114.3343, 609372,
                          2};
const std::string kHomopolar = std::string("template = \"homopolar-pm\"\n") + kMagnet;

OracleMachine HomopolarMachine(const std::string& text) {
  return {text.c_str(), 34.1979, 46532.8, 4};
}

struct OracleRun {
  const char* name;
  OracleMachine machine;
  std::vector<std::string> lost;
  const char* cls;
};

class StatorOracleRuns : public ::testing::TestWithParam<OracleRun> {};

TEST_P(StatorOracleRuns, OutlivesALostCoil) {
  const OracleRun& o = GetParam();
  const RigParameters rig = ReadRigText(MachineText(o.machine), "rig.toml");
  const RunResult healthy = RunWithout(rig, {});
  EXPECT_TRUE(healthy.events.empty());
  EXPECT_LT(LargestOrbit(healthy), 2e-6);
  const RunResult r = RunWithout(rig, o.lost);
  EXPECT_EQ(ClassOf(r), o.cls);
  EXPECT_EQ(r.metrics.false_alarms, 0);
  EXPECT_FALSE(r.touchdown);
  EXPECT_LT(LargestOrbit(r), 5e-5);
}

const std::string kHomopolarPair = kHomopolar + "\ncoils = \"pair\"",
                  kHomopolarPole = kHomopolar + "\ncoils = \"pole\"",
                  kHomopolarAxis = kHomopolar + "\ncoils = \"axis\"";

constexpr const char* kAboutLoad = "linearised about the load";

// Quadrants in series: without the lower one the weight takes its place, as a third magnet.
INSTANTIATE_TEST_SUITE_P(
    Oracles, StatorOracleRuns,
    ::testing::Values(
        OracleRun{"Pairs8", kPairs8, {"A.coil4"}, kAboutLoad},
        OracleRun{"Pairs8Equal", kPairs8Equal, {"A.coil4"}, kAboutLoad},
        OracleRun{"Pairs16", kPairs16, {"A.coil4"}, kAboutLoad},
        OracleRun{"Pairs24", kPairs24, {"A.coil4"}, kAboutLoad},
        OracleRun{"CoresEqual", kCoresEqual, {"A.coil4"}, kAboutLoad},
        OracleRun{"Cores", kCores, {"A.coil4"}, kAboutLoad},
        OracleRun{"Cone", kCone, {"A.coil4"}, kAboutLoad},
        OracleRun{"HomopolarPair", HomopolarMachine(kHomopolarPair), {"A.coil3"}, "exact"},
        OracleRun{"HomopolarPole", HomopolarMachine(kHomopolarPole), {"A.coil2"}, "exact"}),
    [](const auto& p) { return std::string(p.param.name); });

// The quadrant that carries the weight, or one beside it, has none that could do its work; a
// homopolar bearing with one coil an axis has none either.
TEST(StatorOracleRuns, WhatCannotBeCarriedDrops) {
  const RigParameters pairs = ReadRigText(MachineText(kPairs8), "rig.toml");
  for (const char* lost : {"A.coil1", "A.coil2"}) {
    const RunResult r = RunWithout(pairs, {lost});
    EXPECT_EQ(ClassOf(r), "none") << lost;
    EXPECT_TRUE(r.touchdown) << lost;
  }
  const RigParameters axis = ReadRigText(MachineText(HomopolarMachine(kHomopolarAxis)), "rig.toml");
  const RunResult r = RunWithout(axis, {"A.coil2"});
  EXPECT_EQ(ClassOf(r), "none");
  EXPECT_TRUE(r.touchdown);
}

// NASA Glenn (GT2001, V004T04A030) held a rotor by two poles of eight: their two pulls and the
// weight sum to zero. So do poles 2 and 3, at 67.5 and 112.5 degrees, under a weight that points
// down.
TEST(StatorOracleRuns, TwoPolesOfEightAndTheWeight) {
  const OracleMachine eight{"template = \"one-coil-per-pole\"\npoles = 8", 125.6637, 628318.5, 2};
  const RigParameters rig = ReadRigText(MachineText(eight), "rig.toml");
  const RunResult r =
      RunWithout(rig, {"A.coil1", "A.coil4", "A.coil5", "A.coil6", "A.coil7", "A.coil8"});
  EXPECT_EQ(ClassOf(r), kAboutLoad);
  EXPECT_FALSE(r.drop);
}

// One magnet on each side of the disk: without the lower one the weight holds against the upper
// one.
TEST(StatorOracleRuns, DoubleActingAxial) {
  std::string text = MachineText(kPairs8);
  text.replace(text.find("[0.0, -9.81, 0.0]"), 17, "[0.0, 0.0, -9.81]");
  const double mass = 0.2 * 31.4159 * 2 / 9.81;
  text.replace(text.find("mass = "), text.find("inertia_transverse") - text.find("mass = "),
               fmt::format("mass = {:e}\n", mass));
  text += fmt::format(
      "[bearings.Z]\nkind = \"axial-stator\"\ntemplate = \"axial\"\nturns = 100\n"
      "pole_area = 2.0e-4\ngap = 4.0e-4\nleakage_inductance = 1.0e-3\nresistance = 1.0\n"
      "sensor = {{ noise = 1.0e-7 }}\ncontroller = {{ kp = 3.2e5, kd = {:e}, ki = 3.2e6, "
      "derivative_time_constant = 1.0e-4, f_max = 60.0 }}\n"
      "auxiliary = {{ clearance = 2.0e-4, stiffness = 1.0e7, damping = 0.5, friction = 0.15 }}\n",
      1.4 * std::sqrt(157079.6 * mass));
  const RigParameters rig = ReadRigText(text, "rig.toml");
  EXPECT_LT(LargestOrbit(RunWithout(rig, {})), 2e-6);
  const RunResult lower = RunWithout(rig, {"Z.coil2"});
  EXPECT_EQ(ClassOf(lower), kAboutLoad);
  EXPECT_FALSE(lower.touchdown);
  const RunResult upper = RunWithout(rig, {"Z.coil1"});
  EXPECT_EQ(ClassOf(upper), "none");
  EXPECT_TRUE(upper.touchdown);
}

/// What was told of a fault of one coil at 0.05 s: class and coil, and whether the rotor touched.
RunResult RunWithFault(const RigParameters& rig, const std::string& fault) {
  return Simulate(rig,
                  ReadScenarioText("rig = \"rig.toml\"\nduration = 0.15\nrecord_rate = 12500.0\n"
                                   "seed = 1\n[speed]\nprofile = [[0.0, 157.08]]\n[[fault]]\n"
                                   "time = 0.05\n" +
                                       fault,
                                   "scenario.toml", rig),
                  {});
}

// Gross faults of coils that still carry current, on stators of all kinds.
TEST(StatorOracleRuns, ShortsSensorsAndSwitchesAreTold) {
  for (const OracleMachine& m :
       {OracleMachine{"template = \"one-coil-per-pole\"\npoles = 6", 90, 471238, 2}, kPairs8,
        HomopolarMachine(kHomopolarPair)}) {
    const RigParameters rig = ReadRigText(MachineText(m), "rig.toml");
    const std::pair<const char*, const char*> faults[] = {
        {"target = \"A.coil2\"\nkind = \"partial-short\"\nparameters = { fraction = 0.4 }\n",
         "partial-short"},
        {"target = \"A.coil2\"\nkind = \"current-sensor\"\nparameters = { stuck = true }\n",
         "current-sensor"},
        {"target = \"A.coil2\"\nkind = \"switch-stuck-on\"\n", "switch-stuck-on"}};
    for (const auto& [fault, cls] : faults) {
      const RunResult r = RunWithFault(rig, fault);
      std::string told;
      double fraction = 0;
      for (const RunEvent& e : r.events)
        if (e.kind == "classified" && told.empty()) {
          told = e.target + " " + e.fault_class;
          fraction = e.fraction;
        }
      EXPECT_EQ(told, std::string("A.coil2 ") + cls) << m.stator;
      if (told == "A.coil2 partial-short") {
        EXPECT_NEAR(fraction, 0.4, 0.05) << m.stator;
      }
    }
  }
}

}  // namespace
}  // namespace ambrig
