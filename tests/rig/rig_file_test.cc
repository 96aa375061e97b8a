// What a rig file says arrives in the parameters, once, with its spreads; mistakes are one line
// each.
#include "rig/rig_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_checks.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

RigParameters Read(const std::string& text) { return ReadRigText(text, "rig.toml"); }

/// The message of the mistake that the reference rig has once `from` became `to`.
std::string Message(const std::string& from, const std::string& to) {
  try {
    Read(Replaced(ReferenceRigText(), from, to));
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  return "no mistake";
}

const Tolerance* ToleranceOf(const RigParameters& rig, const std::string& path) {
  for (const Tolerance& t : rig.tolerances)
    if (t.path == path) return &t;
  return nullptr;
}

TEST(RigFile, NumbersArriveInSi) {
  const RigParameters rig = Read(ReferenceRigText());
  EXPECT_EQ(rig.name, "reference");
  EXPECT_EQ(rig.rotor.mass, 4.2);
  EXPECT_EQ(rig.gravity[1], -9.81);
  EXPECT_EQ(rig.amplifier.modulation, Modulation::kBiState);
  EXPECT_EQ(rig.amplifier.duty_min, 0.02);
  EXPECT_EQ(rig.samples_per_period(), 18);
  EXPECT_EQ(rig.periods_per_control(), 2);
  EXPECT_EQ(rig.Find("A")->radial.first_pole_angle_deg, 22.5);
  EXPECT_EQ(rig.Find("C"), nullptr);
}

TEST(RigFile, DutyLimitsAreWhatTheFileSays) {
  const RigParameters rig =
      Read(Replaced(ReferenceRigText(), "duty_limits = [0.02, 0.98]", "duty_limits = [0.1, 0.7]"));
  EXPECT_EQ(rig.amplifier.duty_min, 0.1);
  EXPECT_EQ(rig.amplifier.duty_max, 0.7);
}

// `like` copies values and spreads, not the place of its own auxiliary bearing.
TEST(RigFile, ABearingLikeAnotherHasItsValuesAndSpreads) {
  const RigParameters rig = Read(ReferenceRigText());
  const BearingParameters &a = *rig.Find("A"), &b = *rig.Find("B");
  EXPECT_EQ(b.radial.gap, a.radial.gap);
  EXPECT_EQ(b.auxiliary->clearance, a.auxiliary->clearance);
  EXPECT_EQ(b.z, 0.13);
  EXPECT_EQ(b.sensor.z, 0.145);
  ASSERT_NE(ToleranceOf(rig, "bearings.B.gap"), nullptr);
  EXPECT_EQ(ToleranceOf(rig, "bearings.B.gap")->sd, ToleranceOf(rig, "bearings.A.gap")->sd);
  const RigParameters own =
      Read(Replaced(ReferenceRigText(), "z = 0.130", "z = 0.130\ngap = 5.0e-4"));
  EXPECT_EQ(own.Find("B")->radial.gap, 5e-4);
  EXPECT_EQ(ToleranceOf(own, "bearings.B.gap"), nullptr);  // a number without an sd of its own
  EXPECT_NE(ToleranceOf(own, "bearings.A.gap"), nullptr);
}

// A spread of a value that the bearing gives itself, in a table of its own, is not the other's.
TEST(RigFile, ABearingLikeAnotherHasOneSpreadOfEachNumber) {
  const std::string spread = Replaced(ReferenceRigText(), "sensor = { z = -0.135",
                                      "sensor = { z = { value = -0.135, sd = 1e-4 }");
  EXPECT_NE(ToleranceOf(Read(spread), "bearings.A.sensor.z"), nullptr);
  EXPECT_EQ(ToleranceOf(Read(spread), "bearings.B.sensor.z"), nullptr);
  const RigParameters own =
      Read(Replaced(spread, "sensor = { z = 0.145", "sensor = { z = { value = 0.145, sd = 3e-4 }"));
  const auto count = std::ranges::count(own.tolerances, "bearings.B.sensor.z", &Tolerance::path);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(ToleranceOf(own, "bearings.B.sensor.z")->sd, 3e-4);
}

TEST(RigFile, BearingsComeByKindAndName) {
  const std::string text = ReferenceRigText();
  const RigParameters rig = Read(text);
  std::vector<std::string> names;
  for (const BearingParameters& b : rig.bearings) names.push_back(b.name);
  EXPECT_THAT(names, ElementsAre("A", "B", "Z"));
  EXPECT_EQ(rig.bearings[2].kind, FindBearingKind("thrust"));
  EXPECT_EQ(rig.bearings[2].controller->f_max, 120);
  EXPECT_FALSE(rig.bearings[0].controller);
}

TEST(RigFile, OtherControllersShareRateAndBias) {
  const RigParameters rig =
      Read(ReferenceRigText() +
           "\n[controllers.soft]\nkind = \"pid\"\nkp = 2.0e5\nkd = 600.0\nki = 1.0e6\n"
           "derivative_time_constant = 2.0e-4\nf_max = 40.0\n");
  ASSERT_EQ(rig.other_controllers.size(), 1u);
  EXPECT_EQ(rig.other_controllers[0].name, "soft");
  EXPECT_EQ(rig.other_controllers[0].pid.kp, 2e5);
  EXPECT_EQ(rig.other_controllers[0].rate, rig.controller.rate);
  EXPECT_EQ(rig.other_controllers[0].bias_current, rig.controller.bias_current);
}

// What a detector that is not in the catalogue is answered with: the place where the file named it.
TEST(RigFile, TheDetectorRemembersItsLine) {
  const RigParameters rig =
      Read(Replaced(ReferenceRigText(), "[detection]\n", "[detection]\nkind = \"coupled\"\n"));
  EXPECT_EQ(rig.detection.kind, "coupled");
  EXPECT_THAT(rig.detection.where, StartsWith("rig.toml:"));
  EXPECT_THAT(rig.detection.where, HasSubstr("detection.kind"));
}

// A rig that a program fills itself is watched as one whose file names no detector.
TEST(RigFile, TheDefaultDetectorIsThatOfTheParameters) {
  EXPECT_EQ(Read(ReferenceRigText()).detection.kind, RigParameters().detection.kind);
}

TEST(RigFile, TheSpeedSensorHasWholePulses) {
  const std::string sensor = "\n[speed_sensor]\npulses_per_revolution = ";
  EXPECT_EQ(Read(ReferenceRigText() + sensor + "60.0\n").speed_sensor.pulses_per_revolution, 60);
  EXPECT_THROW(Read(ReferenceRigText() + sensor + "60.5\n"), InputError);
}

// Every number of every table: written once, read back, inside its range, and no path twice.
TEST(RigParameters, EveryPathLeadsToOneNumberInsideItsRange) {
  RigParameters rig = Read(ReferenceRigText());
  std::set<std::string> seen;
  for (const std::string& path : ParameterPaths(rig)) {
    EXPECT_TRUE(seen.insert(path).second) << path;
    double lo = 0, hi = 0;
    std::string unit;
    ASSERT_TRUE(ParameterRange(rig, path, &lo, &hi, &unit)) << path;
    EXPECT_FALSE(unit.empty()) << path;
    EXPECT_LT(lo, hi) << path;
    const double value = *ParameterAt(rig, path);
    if (std::isnan(value)) continue;  // not given
    EXPECT_GE(value, lo) << path;
    EXPECT_LE(value, hi) << path;
    EXPECT_TRUE(SetParameter(rig, path, value + 0.125)) << path;
    EXPECT_EQ(*ParameterAt(rig, path), value + 0.125) << path;
    EXPECT_TRUE(SetParameter(rig, path, value)) << path;
  }
  EXPECT_EQ(ParameterAt(rig, "rotor.colour"), nullptr);
  EXPECT_FALSE(SetParameter(rig, "bearings.C.gap", 1));
  double lo, hi;
  std::string unit;
  EXPECT_FALSE(ParameterRange(rig, "gap", &lo, &hi, &unit));
}

TEST(RigParameters, EveryRowOfThePageIsDescribed) {
  std::set<std::string> sections;
  for (const ParameterRow& row : RigParameterRows()) {
    sections.insert(row.section);
    EXPECT_FALSE(row.doc.empty()) << row.section << row.key;
    EXPECT_FALSE(row.unit.empty()) << row.section << row.key;
    EXPECT_LT(row.lo, row.hi) << row.section << row.key;
    if (!std::isnan(row.fallback) && std::isfinite(row.fallback)) {
      EXPECT_GE(row.fallback, row.lo) << row.section << row.key;
      EXPECT_LE(row.fallback, row.hi) << row.section << row.key;
    }
  }
  for (const char* section : {"[rotor]", "[amplifier]", "[bearings.A] kind = \"radial\"",
                              "[bearings.Z] kind = \"thrust\"", "[bearings.M] kind = \"opposed\""})
    EXPECT_TRUE(sections.contains(section)) << section;
}

// A stretch to either side of the bearings as long as their distance, at least to the centre of
// mass.
TEST(ShaftExtent, OfARigidRotorReachesBeyondItsBearings) {
  RigParameters rig = Read(ReferenceRigText());
  const auto [lo, hi] = ShaftExtent(rig);
  EXPECT_DOUBLE_EQ(lo, -0.12 - 0.25);
  EXPECT_DOUBLE_EQ(hi, 0.13 + 0.25);
  for (BearingParameters& b : rig.bearings) b.z += 1;  // both on one side
  EXPECT_EQ(ShaftExtent(rig).first, 0);
}

TEST(ShaftExtent, OfABeamIsTheBeam) {
  const RigParameters rig = ReadRig(AMBRIG_SOURCE_DIR "/examples/tum_mbtr/rig.toml");
  double length = 0;
  for (const ShaftSection& s : rig.beam->definition.sections)
    if (s.stiff) length += s.length;
  const auto [lo, hi] = ShaftExtent(rig);
  EXPECT_NEAR(hi - lo, length, 1e-12);
  EXPECT_LT(lo, 0);  // z counts from the centre of mass
  EXPECT_GT(hi, 0);
  for (const BearingParameters& b : rig.bearings) EXPECT_TRUE(lo < b.z && b.z < hi) << b.name;
}

TEST(RigFile, ContradictionsAreNamedAtTheirLine) {
  EXPECT_THAT(
      Message("clearance = 2.0e-4", "clearance = 6.0e-4"),
      StartsWith("rig.toml:57: bearings.A.auxiliary.clearance = 0.0006 m, allowed: smaller"));
  EXPECT_THAT(Message("z = 0.130", "z = -0.120"),
              HasSubstr("bearings.A.z = -0.12 m, allowed: another plane than bearing B"));
  EXPECT_THAT(Message("\nsensor = { z = 0.145, noise = 2.0e-7 }", ""),
              HasSubstr("sensor: z = -0.135 m, allowed: another plane than the sensor of bearing"));
  EXPECT_THAT(Message("like = \"A\"", "like = \"C\""),
              HasSubstr("bearings.B.like = \"C\", allowed: a bearing with its own values: A"));
  EXPECT_THAT(
      Message("rate = 12500.0", "rate = 12000.0"),
      HasSubstr("controller.rate = 12000 Hz, allowed: the switching frequency of 25000 Hz"));
  EXPECT_THAT(Message("i_max = 6.0", "i_max = 12.0"),
              HasSubstr("amplifier.i_max = 12 A, allowed: at most adc_range = 10 A"));
  EXPECT_THAT(Message("adc_jitter = 2.0e-8", "adc_jitter = 3e-7"),
              HasSubstr("amplifier.adc_jitter = 3e-07 s, allowed: at most 2.22e-07 s"));
  EXPECT_THAT(Message("i_max = 6.0", "i_max = 6.0\nunit = 1.5"),
              HasSubstr("amplifier.unit = 1.5, allowed: an integer"));
  EXPECT_THAT(Message("bias_current = 2.0", "bias_current = 7.0"),
              HasSubstr("controller.bias_current = 7 A, allowed: at most the amplifier's i_max"));
  EXPECT_THAT(Message("duty_limits = [0.02, 0.98]", "duty_limits = [0.98, 0.02]"),
              HasSubstr("amplifier.duty_limits"));
  EXPECT_THAT(Message("winding = \"NSNSNSNS\"", "winding = \"NNNNNNNN\""),
              HasSubstr("both letters N and S"));
  EXPECT_THAT(Message("inertia_polar = { value = 0.0042", "inertia_polar = { value = 0.09"),
              HasSubstr("rotor.inertia_polar = 0.09 kg m2, allowed: at most twice"));
  EXPECT_THAT(Message("inertia_transverse = { value = 0.036", "inertia_transverse = { value = 1e6"),
              HasSubstr("rotor.inertia_transverse = 1e+06 kg m2 of 4.2 kg, allowed: at most 420"));
  EXPECT_THAT(Message("sensor = { z = -0.135", "sensor = { z = -0.9"),
              HasSubstr("bearings.A.sensor: has z = -0.9 m, allowed: on the shaft"));
  EXPECT_THAT(Message("adc_samples_per_period = 18", "adc_samples_per_period = 17.5"),
              HasSubstr("amplifier.adc_samples_per_period = 17.5, allowed: an integer"));
  EXPECT_THAT(Message("sd = 4.0e-6", "sd = 5.0e-4"), HasSubstr("bearings.A.gap.sd"));
  EXPECT_THAT(Message("z = -0.120", "z = -0.120\ncoil_errors = { current_gain = [0.01, 0.02] }"),
              HasSubstr("bearings.A.coil_errors.current_gain: has 2 numbers, allowed: 8"));
  EXPECT_THAT(Message("z = -0.120", "z = -0.120\ncoil_errors = { edges = [] }"),
              HasSubstr("coil_errors.edges"));
}

TEST(RigFile, EveryTableRefusesKeysThatItDoesNotKnow) {
  for (const std::string table :
       {"[rotor]", "[amplifier]", "[controller]", "[bearings.A]", "[bearings.Z]"})
    EXPECT_THAT(Message("\n" + table + "\n", "\n" + table + "\ncolour = 1\n"),
                HasSubstr(".colour: unknown key"))
        << table;
  EXPECT_THAT(Message("noise = 2.0e-7 }               # m, m rms", "noise = 2.0e-7, colour = 1 }"),
              HasSubstr("sensor.colour: unknown key"));
}

TEST(RigFile, ABearingIsNotEnough) {
  EXPECT_THAT(Message("[bearings.B]\nlike = \"A\"                                   # same values, "
                      "other places\nz = 0.130\nsensor = { z = 0.145, noise = 2.0e-7 }",
                      ""),
              HasSubstr("a rigid rotor needs at least two radial bearings"));
}

TEST(RigFile, AnEffectStandsOnceOnItsTarget) {
  const std::string pull =
      "\n[[effect]]\nname = \"side-pull\"\ntarget = \"A\"\nparameters = { stiffness = 1.0e4 }\n";
  EXPECT_EQ(Read(ReferenceRigText() + pull).effects.size(), 1u);
  try {
    Read(ReferenceRigText() + pull + pull);
    FAIL() << "twice";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("\"side-pull\" on A stands twice (first rig.toml:"));
  }
}

// What is simulated must be as possible as what is drawn, each number and all together.
TEST(RigFile, FittedValuesAreCheckedAsTheOthers) {
  const std::string resistance = "resistance = { value = 0.5, sd = 0.01";
  for (const char* fitted : {"-0.5", "0.0", "5e9"})
    EXPECT_THAT(Message(resistance, resistance + ", fitted = " + fitted),
                AllOf(HasSubstr("bearings.A.resistance.fitted = "), HasSubstr("allowed")))
        << fitted;
  const std::string mass = "mass = { value = 4.2, sd = 0.01";
  EXPECT_THAT(Message(mass, mass + ", fitted = -3.0"), HasSubstr("rotor.mass.fitted = -3 kg"));
  EXPECT_THAT(Message("bus_voltage = 30.0", "bus_voltage = { value = 30.0, fitted = -30.0 }"),
              HasSubstr("amplifier.bus_voltage.fitted = -30 V"));
  const std::string gap = "gap = { value = 4.0e-4, sd = 4.0e-6";
  EXPECT_THAT(Message(gap, gap + ", fitted = 1.5e-4"),
              AllOf(HasSubstr("bearings.A.gap = 0.00015 m with the fitted values"),
                    HasSubstr("auxiliary clearance")));
  const std::string polar = "inertia_polar = { value = 0.0042, sd = 0.00005";
  EXPECT_THAT(Message(polar, polar + ", fitted = 0.5"),
              AllOf(HasSubstr("rotor.inertia_polar = 0.5 kg m2 with the fitted values"),
                    HasSubstr("twice inertia_transverse")));
  EXPECT_EQ(Message(gap, gap + ", fitted = 3.9e-4"), "no mistake");
  EXPECT_THAT(Message(mass, mass + ", fit = 4.0"), HasSubstr("allowed: value, sd, fitted"));
}

}  // namespace
}  // namespace ambrig
