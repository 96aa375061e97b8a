/// The reference engine against closed forms: RL coil, free fall, restitution, energy balance.
#include <gtest/gtest.h>

#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/rotor/restitution.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

/// One magnet on a bench: 48 V bridge, R 0.5 ohm, L 5 mH, 20 kHz (published_values.md 6). 20
/// samples per period put the edge of duty 0.55 on a sample.
RigParameters BridgeRig() {
  return ReadRigText(R"(
name = "bridge"
gravity = [0.0, 0.0, 0.0]
[rotor]
kind = "point"
mass = 1.0
[amplifier]
modulation = "bi-state"
bus_voltage = 48.0
switching_frequency = 20000.0
quadrants = 4
kp = 4.0
ki = 2000.0
adc_samples_per_period = 20
adc_range = 20.0
i_max = 20.0
[controller]
kind = "pid"
rate = 20000.0
kp = 1.0
kd = 0.0
ki = 0.0
derivative_time_constant = 1.0e-4
f_max = 60.0
bias_current = 1.0
[bearings.M]
kind = "opposed"
coils = 1
gap = 1.0
gap_constant = 1.0
inductance_far = 4.999e-3
inductance_near = 2.0e-6
resistance = 0.5
sensor = { noise = 0.0 }
)",
                     "bridge.toml");
}

Scenario BridgeScenario(const RigParameters& rig) {
  return ReadScenarioText(R"(
name = "bridge"
rig = "bridge.toml"
duration = 0.1
record_rate = 400000.0
seed = 1
noise = false
[start]
state = "clamped"
[[excitation]]
target = "M.coil1"
port = "duty"
kind = "step"
amplitude = 0.55
)",
                          "bridge-run.toml", rig);
}

// Every sample on the exact exponential, to the integrator's tolerance over 2600 periods; then the
// published mean 9.6000 A and ripple 0.23760 A p-p.
TEST(ReferenceClosedForm, BridgeOnAnRlCoil) {
  const RigParameters rig = BridgeRig();
  const Scenario scenario = BridgeScenario(rig);
  const Record record = RunReference(rig, scenario).record;
  const std::vector<double>& i = record.Find("M.i1")->samples;
  ASSERT_EQ(i.size(), 40000u);
  const double R = 0.5, L = 5e-3, h = 1 / 400e3, decay = std::exp(-R / L * h);
  double exact = 0;
  std::size_t k = 0;
  double worst = 0;
  for (int n = -600; n < 2000; ++n)
    for (int s = 0; s < 20; ++s) {
      if (n >= 0) worst = std::max(worst, std::abs(i[k++] - exact));
      const double settled = (s < 11 ? 48.0 : -48.0) / R;
      exact = settled + (exact - settled) * decay;
    }
  EXPECT_LT(worst, 1e-9);
  double low = 1e9, high = -1e9, mean = 0;
  for (std::size_t q = i.size() - 20; q < i.size(); ++q) {
    low = std::min(low, i[q]);
    high = std::max(high, i[q]);
    mean += i[q] / 20;
  }
  EXPECT_NEAR(mean, 9.6000, 6e-5);  // five digits published; exp(-13) of the start is left
  EXPECT_NEAR(high - low, 0.23760, 5e-6);
}

TEST(ReferenceClosedForm, FastEngineHasTheSameRipple) {
  const RigParameters rig = BridgeRig();
  const Scenario scenario = BridgeScenario(rig);
  const Record record = SwitchingEngine(rig, scenario, {}).Run().record;
  const std::vector<double>& i = record.Find("M.i1")->samples;
  const auto last = i.end() - 20;
  double mean = 0;
  for (auto q = last; q != i.end(); ++q) mean += *q / 20;
  EXPECT_NEAR(mean, 9.6000, 6e-5);
  EXPECT_NEAR(*std::max_element(last, i.end()) - *std::min_element(last, i.end()), 0.23760, 5e-6);
}

// v = (2 d - 1) U_d = 4.8 V on R: 9.6 A (1 - exp(-t R/L)), the switching mean without its ripple.
TEST(ReferenceClosedForm, AveragedBridgeIsThePlainExponential) {
  const RigParameters rig = BridgeRig();
  Scenario scenario = BridgeScenario(rig);
  scenario.record_rate = 20000;
  const Record record = RunAveraged(rig, scenario).record;
  const std::vector<double>& i = record.Find("M.i1")->samples;
  const double rate = 0.5 / 5e-3, T = 1 / 20e3;
  for (std::size_t k = 0; k < i.size(); k += 100) {
    const double end =
        0.03 + static_cast<double>(k) * T;  // the row holds the mean of the period before
    const double mean =
        9.6 * (1 - (std::exp(-rate * (end - T)) - std::exp(-rate * end)) / (rate * T));
    EXPECT_NEAR(i[k], mean, 1e-6);
  }
}

/// The base rig with magnets that pull nothing, symmetric bearings without friction.
RigParameters LooseRotor(double clearance, double damping) {
  RigParameters rig = BaseRig();
  rig.tolerances.clear();
  rig.controller.pid.kp = rig.controller.pid.kd = rig.controller.pid.ki = 0;
  rig.controller.bias_current = 1e-6;
  double side = -0.1;
  for (BearingParameters& b : rig.bearings) {
    b.z = b.sensor.z = side;
    side = -side;
    b.radial.turns = 1;
    b.radial.pole_area = 1e-12;  // 6 A through it pull less than a piconewton
    b.radial.leakage_inductance = 1;
    b.radial.gap = 0.02;
    b.auxiliary->clearance = clearance;
    b.auxiliary->friction = 0;
    b.auxiliary->exponent = 1.5;
    b.auxiliary->stiffness = 2.4614e8;
    b.auxiliary->damping = damping;
  }
  return rig;
}

Scenario LooseScenario(const RigParameters& rig, double duration) {
  Scenario s = BaseScenario("lift-off", rig);
  s.start = StartState::kLevitated;
  s.duration = duration;
  s.speed = SpeedProfile();
  return s;
}

TEST(ReferenceClosedForm, FreeFall) {
  const RigParameters rig = LooseRotor(2e-3, 0);
  const Scenario scenario = LooseScenario(rig, 0.02);
  ReferenceOptions options;
  options.sampled.warm_up = 0;
  const Record record = RunReference(rig, scenario, options).record;
  const std::vector<double>& y = record.Find("A.r.y")->samples;
  for (std::size_t k = 0; k < y.size(); k += 10) {
    const double t = static_cast<double>(k) / 12500;
    EXPECT_NEAR(y[k], -0.5 * 9.81 * t * t, 1e-13);
  }
}

// √(2c/g) = 6.386 ms through a clearance of 0.2 mm: the verdict names the period in which it is
// over.
TEST(ReferenceClosedForm, TouchdownAfterTheFreeFallTime) {
  const RigParameters rig = LooseRotor(2e-4, 0);
  const Scenario scenario = LooseScenario(rig, 0.008);
  const double fall = std::sqrt(2 * 2e-4 / 9.81);
  EngineOptions fast;
  fast.warm_up = 0;
  ReferenceOptions reference;
  reference.sampled.warm_up = 0;
  for (const RunResult& r :
       {SwitchingEngine(rig, scenario, fast).Run(), RunReference(rig, scenario, reference)}) {
    EXPECT_TRUE(r.touchdown);
    ASSERT_FALSE(r.events.empty());
    EXPECT_EQ(r.events.front().kind, "touchdown");
    EXPECT_GE(r.events.front().t, fall);
    EXPECT_LT(r.events.front().t, fall + 40e-6);
  }
}

class Bounce : public ::testing::TestWithParam<std::pair<double, double>> {};

// Without gravity, pushed to v = 0.1 m/s, the rotor meets both bearings at once and comes back with
// the published restitution; what it has lost went into the contacts.
TEST_P(Bounce, Restitution) {
  const auto [nominal, actual] = GetParam();
  const double v = 0.1, a = 1.5 * (1 - nominal);
  RigParameters rig = LooseRotor(1e-3, a / v);
  Scenario scenario = LooseScenario(rig, 0.025);
  rig.gravity = {0, 0, 0};  // a scenario file would not start a rotor at rest without weight
  scenario.loads.push_back({0, false, 0, -rig.rotor.mass * v / 0.002, 0, 0, 0.002});
  ReferenceOptions options;
  options.sampled.warm_up = 0;
  std::vector<EnergyBalance> energies;
  const RunResult result = RunReference(rig, scenario, options, &energies);
  const std::vector<double>& y = result.record.Find("A.r.y")->samples;
  const auto speed = [&](double from, double to) {
    return (y[static_cast<std::size_t>(to * 12500)] - y[static_cast<std::size_t>(from * 12500)]) /
           (to - from);
  };
  EXPECT_NEAR(speed(0.004, 0.008), -v, 1e-10);
  const double e = speed(0.016, 0.024) / v;
  EXPECT_NEAR(e, Restitution(a / v, v), 1e-7);
  EXPECT_NEAR(e, actual, 5e-6);  // five digits published
  EXPECT_TRUE(result.touchdown);
  EXPECT_FALSE(result.drop);
  const double kinetic = 0.5 * rig.rotor.mass * v * v;
  EXPECT_NEAR(energies.back().contact, kinetic * (1 - e * e), 1e-8 * kinetic);
  EXPECT_NEAR(energies.back().drive, kinetic, 1e-10 * kinetic);
}

INSTANTIATE_TEST_SUITE_P(HuntCrossley, Bounce,
                         ::testing::Values(std::pair{0.9, 0.90902}, std::pair{0.76, 0.80573},
                                           std::pair{0.5, 0.66296}));

// Electrical + drive = copper + field + rotor + contact: what is left is the tolerance of a step
// (1e-10) times the energy that went through, with a margin of ten for the sum over the steps.
TEST(ReferenceClosedForm, EnergyBalanceOfLiftOffWithContactAndFriction) {
  const RigParameters rig = BaseRig();
  Scenario scenario = BaseScenario("lift-off", rig);
  scenario.duration = 0.03;
  std::vector<EnergyBalance> all;
  RunReference(rig, scenario, {}, &all);
  const EnergyBalance &a = all.front(), &b = all.back();
  const double in = b.electrical - a.electrical + b.drive - a.drive;
  const double out =
      b.copper - a.copper + b.contact - a.contact + b.field - a.field + b.rotor - a.rotor;
  EXPECT_GT(b.contact - a.contact, 0.1);  // it does rub: quarter of a joule
  EXPECT_GT(b.electrical - a.electrical, 0.4);
  RecordProperty("left_of_the_input",
                 std::to_string((in - out) / (b.electrical + std::abs(b.drive)) * 1e12) + "e-12");
  EXPECT_NEAR(in, out, 1e-9 * (b.electrical + std::abs(b.drive)));
}

TEST(ReferenceClosedForm, EnergyBalanceOfALoadOnALevitatedRotor) {
  const RigParameters rig = BaseRig();
  Scenario scenario = BaseScenario("steps", rig);
  scenario.excitations.clear();
  scenario.loads = {{-0.12, false, 0, -12, 0, 0.0033, 0.0101}};
  scenario.duration = 0.02;
  ReferenceOptions options;
  options.sampled.warm_up = 0.004;
  std::vector<EnergyBalance> all;
  RunReference(rig, scenario, options, &all);
  const EnergyBalance &a = all.front(), &b = all.back();
  const double in = b.electrical - a.electrical + b.drive - a.drive;
  const double out =
      b.copper - a.copper + b.contact - a.contact + b.field - a.field + b.rotor - a.rotor;
  EXPECT_GT(std::abs(b.drive), 1e-6);  // the load has worked
  EXPECT_NEAR(b.magnetic_work - a.magnetic_work + b.drive - a.drive, b.rotor - a.rotor, 1e-11);
  EXPECT_NEAR(in, out, 1e-9 * b.electrical);
}

}  // namespace
}  // namespace ambrig
