/// The fast engine against the reference, trajectory by trajectory, with its order of convergence,
/// and the reference against itself at a tighter tolerance.
#include <gtest/gtest.h>

#include "effects/catalogue.h"
#include "rig/rig_file.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

struct Case {
  RigParameters rig = BaseRig();
  Scenario scenario;
  double warm_up = 0.02;  // [s] both engines, from the same start

  Record Reference(double tolerance = 1e-10, int order = 5, bool stiff = false) const {
    ReferenceOptions o;
    o.sampled.warm_up = warm_up;
    o.integrator = {tolerance, order, stiff};
    return RunReference(rig, scenario, o).record;
  }
  Difference Fast(const Record& reference, int substeps) const {
    EngineOptions o;
    o.warm_up = warm_up;
    o.substeps = substeps;
    return Compare(SwitchingEngine(rig, scenario, o).Run().record, reference);
  }
};

Case Burst() {
  Case c;
  c.scenario = BaseScenario("coil-burst", c.rig);
  return c;
}

Case Levitated(double duration) {
  Case c;
  c.scenario = BaseScenario("steps", c.rig);
  c.scenario.excitations.clear();
  c.scenario.loads = {{-0.12, false, 0, -12, 0, 0.002, 0.006}};
  c.scenario.speed = SpeedProfile(std::vector<std::vector<double>>{{0.0, 157.0}});
  c.scenario.duration = duration;
  return c;
}

Excitation StepTo(const std::string& coil, double amperes) {
  Excitation e;
  e.target = coil;
  e.port = "current";
  e.kind = "step";
  e.amplitude = amperes;
  return e;
}

void AddFault(Case& c, const std::string& kind, double time,
              std::map<std::string, double> parameters) {
  c.scenario.faults.push_back({time, "A.coil3", kind, std::move(parameters), "test"});
}

// Clamped coils at 450 kHz, set-points switched, diodes blocking: second order in the step.
TEST(ReferenceWitness, FastEngineConvergesWithOrderTwoOnClampedCoils) {
  const Case c = Burst();
  const Record reference = c.Reference();
  double rms[4];
  for (int k = 0; k < 4; ++k) rms[k] = c.Fast(reference, 1 << k).current_rms;
  // With one step per sample both edges of a coil fall into a few steps and their errors cancel in
  // part; from two steps on the order shows.
  EXPECT_LT(c.Fast(reference, 1).current, 1e-4);
  EXPECT_LT(rms[1], rms[0]);
  EXPECT_NEAR(std::log2(rms[1] / rms[3]) / 2, 2, 0.3)
      << rms[0] << " " << rms[1] << " " << rms[2] << " " << rms[3];
  EXPECT_LT(rms[3], 5e-7);
}

// The levitated rotor under a load step while it turns.
TEST(ReferenceWitness, FastEngineConvergesOnALevitatedRotor) {
  const Case c = Levitated(0.015);
  const Record reference = c.Reference();
  const Difference once = c.Fast(reference, 1), four = c.Fast(reference, 4);
  EXPECT_LT(once.position, 2e-8);  // what the base records ask for
  EXPECT_LT(once.current, 2e-3);
  EXPECT_LT(four.position, 0.5 * once.position) << once.position << " " << four.position;
  EXPECT_LT(four.current_rms, 0.5 * once.current_rms);
}

// A tighter tolerance, another order and another integrator give the same record: nothing of the
// reference's own is left in the comparisons above.
TEST(ReferenceWitness, ReferenceIsItselfConverged) {
  Case c = Levitated(0.004);
  c.warm_up = 0.002;
  const Record reference = c.Reference();
  const Difference tight = Compare(c.Reference(1e-12, 8), reference);
  EXPECT_LT(tight.position, 1e-13);
  EXPECT_LT(tight.current, 1e-9);
  const Difference bdf = Compare(c.Reference(1e-10, 5, true), reference);  // CVODE
  EXPECT_LT(bdf.position, 1e-11);
  EXPECT_LT(bdf.current, 1e-6);
}

TEST(ReferenceWitness, ThrustBearingToo) {
  Case c = Levitated(0.006);
  c.rig = ReadRig(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml");
  c.scenario.loads.push_back({0, true, 0, 0, 20, 0.001, 0.005});
  const Record reference = c.Reference();
  const Channel* z = reference.Find("r.z");
  ASSERT_TRUE(z);
  EXPECT_GT(*std::max_element(z->samples.begin(), z->samples.end()), 1e-6);  // the load moved it
  const Difference once = c.Fast(reference, 1), four = c.Fast(reference, 4);
  EXPECT_LT(once.position, 2e-8);
  EXPECT_LT(once.current, 2e-3);
  EXPECT_LT(four.current_rms, 0.6 * once.current_rms);
}

// Faults, in the middle of a period on an ADC instant: 25 kHz, sample 7 of period 50.
constexpr double kFaultTime = 50 * 40e-6 + 7 * 40e-6 / 18;

class FaultWitness
    : public ::testing::TestWithParam<std::pair<std::string, std::map<std::string, double>>> {};

TEST_P(FaultWitness, BothEnginesAgree) {
  // 18 A in a stuck coil tear the rotor away: what differs grows e-fold every 0.2 ms, so look
  // early.
  Case c = Levitated(GetParam().first == "switch-stuck-on" ? 0.0026 : 0.005);
  AddFault(c, GetParam().first, kFaultTime, GetParam().second);
  const Record reference = c.Reference();
  const Difference once = c.Fast(reference, 1), four = c.Fast(reference, 4);
  // 20 nm and 2 mA are asked of healthy records; a fault's transient may double the former.
  EXPECT_LT(once.position, 4e-8);
  EXPECT_LT(once.current, 2e-3);
  EXPECT_LT(four.position,
            4e-8);  // the gap that runs straight through a period stays: not finer steps' matter
  EXPECT_LT(four.current_rms, 0.4 * once.current_rms)
      << once.current_rms << " " << four.current_rms;
}

using Parameters = std::map<std::string, double>;
INSTANTIATE_TEST_SUITE_P(
    Coil, FaultWitness,
    ::testing::Values(std::pair<std::string, Parameters>{"open", {}},
                      std::pair<std::string, Parameters>{
                          "partial-short", {{"fraction", 0.3}, {"short_resistance", 0.05}}},
                      std::pair<std::string, Parameters>{"partial-short", {{"fraction", 0.5}}},
                      std::pair<std::string, Parameters>{"amplifier-off", {}},
                      std::pair<std::string, Parameters>{"switch-stuck-on", {}}),
    [](const auto& which) {
      std::string name =
          which.param.first + (which.param.second.contains("short_resistance") ? "Closed" : "");
      std::erase(name, '-');
      return name;
    });

// Bridges of four quadrants: the diodes of one that is off end a current of either sign, and it
// stays away until the bridge drives again.
TEST(ReferenceWitness, ABridgeOfFourQuadrantsThatIsOff) {
  for (const double before : {1.5, -1.5}) {
    Case c = Burst();
    c.rig.amplifier.quadrants = 4;
    c.scenario.duration = 0.005;
    c.scenario.record_rate = 25e3;  // means of the periods
    c.scenario.excitations = {StepTo("A.coil3", before), StepTo("A.coil4", 1.0)};
    c.scenario.faults = {
        {kFaultTime, "A.coil3", "amplifier-off", {{"duration", 25 * 40e-6 - 1e-9}}, "test"}};
    const Record reference = c.Reference();
    const std::vector<double>& i = reference.Find("A.i3")->samples;
    const double rate = reference.rate, back = kFaultTime + 25 * 40e-6;
    const auto at = [&](double t) { return i[static_cast<std::size_t>(std::lround(t * rate))]; };
    EXPECT_NEAR(at(kFaultTime - 80e-6), before, 0.05);
    EXPECT_EQ(at(kFaultTime + 400e-6), 0);
    EXPECT_EQ(at(back - 40e-6), 0);
    EXPECT_GT(at(back + 1e-3) / before, 0.5);
    const Difference once = c.Fast(reference, 1), four = c.Fast(reference, 4);
    EXPECT_LT(once.current, 5e-3) << before;
    EXPECT_LT(four.current_rms, 0.6 * once.current_rms)
        << once.current_rms << " " << four.current_rms;
  }
}

// A clamped start under a current that is not the commanded one.
TEST(ReferenceWitness, StartUnderCurrent) {
  Case c = Burst();
  c.scenario.duration = 0.004;
  c.scenario.record_rate = 25e3;
  c.scenario.excitations = {StepTo("A.coil3", 2.0)};
  c.scenario.start_current = {{"A.coil3", 0.8}};
  const Record reference = c.Reference();
  const std::vector<double>& i = reference.Find("A.i3")->samples;
  EXPECT_NEAR(i.front(), 0.8, 2e-3);
  EXPECT_NEAR(i.back(), 2.0, 0.05);
  const Difference once = c.Fast(reference, 1);
  EXPECT_LT(once.current, 2e-3);
}

// A second short on the same coil is a second loop: each carries its own current, 64 and 110 us
// long.
TEST(ReferenceWitness, TwoShortsOnOneCoil) {
  Case c = Levitated(0.005);
  AddFault(c, "partial-short", kFaultTime, {{"fraction", 0.3}, {"short_resistance", 0.05}});
  const Record first = c.Reference();
  AddFault(c, "partial-short", kFaultTime + 400e-6,
           {{"fraction", 0.2}, {"short_resistance", 0.02}});
  const Record both = c.Reference();
  EXPECT_GT(Compare(first, both).current, 0.05);  // the second one is seen
  const Difference once = c.Fast(both, 1), four = c.Fast(both, 4);
  EXPECT_LT(once.position, 4e-8);
  EXPECT_LT(once.current, 2e-3);
  EXPECT_LT(four.current_rms, 0.4 * once.current_rms);
}

// The loop of a short that found its coil broken stays unused; the next short gets one on its own
// pole.
TEST(ReferenceWitness, AShortOfABrokenCoilChangesNothing) {
  Case c = Levitated(0.004);
  AddFault(c, "open", kFaultTime, {});
  AddFault(c, "partial-short", kFaultTime + 200e-6,
           {{"fraction", 0.3}, {"short_resistance", 0.05}});
  AddFault(c, "partial-short", kFaultTime + 400e-6,
           {{"fraction", 0.3}, {"short_resistance", 0.05}});
  c.scenario.faults.back().target = "A.coil7";
  const Difference once = c.Fast(c.Reference(), 1);
  EXPECT_LT(once.position, 4e-8);
  EXPECT_LT(once.current, 2e-3);
}

// A loop that decays in 1.7 us is stiff: CVODE's BDF carries it, and agrees with the explicit
// method.
TEST(ReferenceWitness, StiffShortByBdf) {
  Case c = Levitated(0.001);
  c.warm_up = 0.0008;
  AddFault(c, "partial-short", 10 * 40e-6, {{"fraction", 0.1}, {"short_resistance", 2.0}});
  const Difference d = Compare(c.Reference(1e-10, 5, true), c.Reference(1e-10, 5, false));
  EXPECT_LT(d.current, 1e-6);
}

TEST(ReferenceWitness, NoiseIsTheFastEnginesNoise) {
  Case c = Levitated(0.002);
  c.scenario.noise = true;
  ReferenceOptions o;
  o.sampled.warm_up = c.warm_up;
  o.sampled.noise = true;
  const Record noisy = RunReference(c.rig, c.scenario, o).record;
  const Difference same = c.Fast(noisy, 4), quiet = Compare(c.Reference(), noisy);
  // A code of the ADC may flip where the two differ by rounding: one LSB in a mean of 18 is 0.27
  // mA.
  EXPECT_LT(same.current, 3e-3);
  EXPECT_GT(quiet.position, 1e-7);
  EXPECT_LT(same.position, 2e-8);
}

TEST(ReferenceWitness, IronLawsAreRefused) {
  Case c = Levitated(0.001);
  c.rig.effects.push_back(MakeInstance(*FindEffect("saturation"), "A"));
  for (const EffectParameter& p : c.rig.effects.back().table)
    c.rig.effects.back().Set(p.name, p.typical_lo > 0 ? p.typical_lo : p.null_value);
  try {
    c.Reference();
    FAIL() << "expected an InputError";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("--fidelity switching"), std::string::npos);
  }
}

}  // namespace
}  // namespace ambrig
