// Amplifiers of every mode against the closed forms of a coil with resistance and inductance.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

constexpr double kR = 4.0, kFar = 0.1, kNear = 0.05, kGapConstant = 0.01, kGapOfCoil = 0.01;
constexpr double kL = kFar + kNear / (1 + kGapOfCoil / kGapConstant);  // [H]
constexpr double kAsked = 0.5, kFrom = 0.01;                           // [A], [s]

RigParameters OneCoil(const std::string& amplifier) {
  return ReadRigText(
      "name = \"coil\"\ngravity = [0.0, 0.0, 0.0]\n[rotor]\nkind = \"point\"\nmass = 1.0\n"
      "[amplifier]\nbus_voltage = 60.0\nswitching_frequency = 10000.0\ni_max = 3.0\n" +
          amplifier +
          "[controller]\nkind = \"pid\"\nrate = 10000.0\nkp = 1.0\nkd = 1.0\nki = 1.0\n"
          "derivative_time_constant = 1.0e-3\nf_max = 1.0\nbias_current = 0.5\n"
          "[bearings.M]\nkind = \"opposed\"\ncoils = 1\ngap = 0.01\nresistance = 4.0\n"
          "inductance_far = 0.1\ninductance_near = 0.05\ngap_constant = 0.01\n"
          "sensor = { noise = 0.0 }\n",
      "rig.toml");
}

/// Current after a step of the set-point from nothing, coil held.
Record StepOf(const RigParameters& rig) {
  const Scenario s = ReadScenarioText(
      "rig = \"rig.toml\"\nduration = 0.1\nnoise = false\nfault_tolerance = false\n"
      "record_rate = 10000.0\n[start]\nstate = \"clamped\"\n[[excitation]]\ntarget = \"M.coil1\"\n"
      "port = \"current\"\nkind = \"step\"\namplitude = 0.5\nstart = 0.01\nstop = 0.1\n",
      "scenario.toml", rig);
  return Simulate(rig, s, {}).record;
}

double LargestError(const Record& r, double settled, double rate) {
  double largest = 0;
  const std::vector<double>& i = r.Find("M.i1")->samples;
  for (std::size_t k = 0; k < i.size(); ++k) {
    // A row's current is the mean of the period before it.
    const double t = r.TimeAt(k) - 0.5 / 10000 - kFrom;
    const double closed = t > 0 ? settled * -std::expm1(-rate * t) : 0;
    largest = std::max(largest, std::abs(i[k] - closed));
  }
  return largest;
}

// Nothing is fed back: u = kp i_set drives R and L.
TEST(AmplifierModes, VoltageModeIsAnOpenLoop) {
  const RigParameters rig =
      OneCoil("modulation = \"linear\"\nquadrants = 4\nmode = \"voltage\"\nkp = 6.0\n");
  const Record r = StepOf(rig);
  // The step is taken at a period's start; a mean over the period of its start is off by an eighth
  // of the period's rise.
  EXPECT_LT(LargestError(r, 6.0 * kAsked / kR, kR / kL), 0.2 * 6.0 * kAsked / kL * 1e-4);
}

// kp = 2π f L, ki = 2π f R: the loop is one pole at f but for the delay of a period and a half.
TEST(AmplifierModes, BandwidthIsThatOfTheCurrent) {
  const double f = 100;
  const RigParameters rig = OneCoil("modulation = \"linear\"\nquadrants = 4\nbandwidth = 100.0\n");
  EXPECT_NEAR(rig.amplifier.kp, 2 * kPi * f * kL, 1e-9);
  EXPECT_NEAR(rig.amplifier.ki, 2 * kPi * f * kR, 1e-9);
  EXPECT_LT(LargestError(StepOf(rig), kAsked, 2 * kPi * f), kAsked * 2 * kPi * f * 1.5e-4);
}

TEST(AmplifierModes, DutiesOfBothSignsBrakeTheCurrent) {
  const std::string with = "modulation = \"linear\"\nquadrants = 4\nbandwidth = 100.0\n";
  EXPECT_EQ(OneCoil(with).amplifier.duty_min, -1);
  EXPECT_EQ(OneCoil(with).amplifier.duty_max, 1);
}

TEST(AmplifierModes, OtherNamesAreTheSameBridges) {
  const std::string gains = "kp = 3.0\nki = 100.0\n";
  EXPECT_EQ(OneCoil("modulation = \"two-level\"\n" + gains).amplifier.modulation,
            Modulation::kBiState);
  EXPECT_EQ(OneCoil("modulation = \"three-level\"\n" + gains).amplifier.modulation,
            Modulation::kTriState);
}

// The amplifier's delay is the effect of that name.
TEST(AmplifierModes, DelayIsTheLoopsDelay) {
  const std::string text = ReferenceRigText();
  const RigParameters own =
      ReadRigText(Replaced(text, "[amplifier]\n", "[amplifier]\ndelay = 1.2e-4\n"), "rig.toml");
  const RigParameters effect = ReadRigText(
      text +
          "\n[[effect]]\nname = \"loop-delay\"\ntarget = \"rig\"\nparameters = { time = 1.2e-4 }\n",
      "rig.toml");
  const std::string scenario =
      "rig = \"rig.toml\"\nduration = 0.02\nfault_tolerance = false\nrecord_rate = 12500.0\n";
  const Record a = Simulate(own, ReadScenarioText(scenario, "s.toml", own), {}).record,
               b = Simulate(effect, ReadScenarioText(scenario, "s.toml", effect), {}).record;
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    EXPECT_EQ(a.channels[c].samples, b.channels[c].samples) << a.channels[c].name;
}

}  // namespace
}  // namespace ambrig
