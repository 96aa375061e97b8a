/// When a command acts: the clocks of base_model.md sections 3 and 4, exact to the period, in all
/// three fidelities. A run with a command is compared with the same run without it: the same bits
/// before.
#include <gtest/gtest.h>

#include "effects/catalogue.h"
#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

enum class Engine { kSwitching, kReference, kAveraged };

void PrintTo(Engine e, std::ostream* out) {
  *out << (e == Engine::kSwitching   ? "switching"
           : e == Engine::kReference ? "reference"
                                     : "averaged");
}

constexpr double kT = 40e-6;
constexpr int kRow = 50;  // of a controller tick: an even period

Record Simulated(Engine engine, const Excitation* command) {
  const RigParameters rig = BaseRig();
  Scenario s = BaseScenario("steps", rig);
  s.excitations.clear();
  s.loads.clear();
  s.duration = 0.004;
  s.record_rate = 25000;
  s.noise = false;
  if (command) s.excitations = {*command};
  if (engine == Engine::kSwitching) {
    EngineOptions o;
    o.warm_up = 0.002;
    return SwitchingEngine(rig, s, o).Run().record;
  }
  if (engine == Engine::kReference) {
    ReferenceOptions o;
    o.sampled.warm_up = 0.002;
    return RunReference(rig, s, o).record;
  }
  AveragedOptions o;
  o.sampled.warm_up = 0.002;
  return RunAveraged(rig, s, o).record;
}

Excitation Step(const std::string& target, const std::string& port, double amplitude,
                double start) {
  Excitation e;
  e.target = target;
  e.port = port;
  e.kind = "step";
  e.amplitude = amplitude;
  e.start = start;
  e.stop = 1;
  return e;
}

/// First row in which a channel differs at all, and by how much there.
struct Change {
  int row = -1;
  double by = 0;
};
Change FirstChange(const Record& with, const Record& without, const std::string& channel) {
  const auto &a = with.Find(channel)->samples, &b = without.Find(channel)->samples;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k] != b[k]) return {static_cast<int>(k), a[k] - b[k]};
  return {};
}

class Clock : public ::testing::TestWithParam<Engine> {
 protected:
  Change Of(const Excitation& e, const std::string& channel) const {
    return FirstChange(Simulated(GetParam(), &e), Simulated(GetParam(), nullptr), channel);
  }
};

const double kCosine1 = std::cos(22.5 * kPi / 180);
// k c0
const double kNewtonPerAmpere = 2 * RadialStator(BaseRig().bearings[0].radial).ForceConstant();

// Read by the controller at t_n, set-points one controller period (two PWM periods) later.
TEST_P(Clock, AForceActsOneControllerPeriodLater) {
  const Change c = Of(Step("A.x", "force", 3, kRow * kT), "A.s1");
  EXPECT_EQ(c.row, kRow + 2);
  EXPECT_NEAR(c.by, 3 / kNewtonPerAmpere * kCosine1, 1e-12);
}

// Half a controller period early or late: the tick that reads it decides.
TEST_P(Clock, BetweenTicksTheNextOneReadsIt) {
  EXPECT_EQ(Of(Step("A.x", "force", 3, (kRow - 1) * kT), "A.s1").row, kRow + 2);
  EXPECT_EQ(Of(Step("A.x", "force", 3, (kRow + 0.01) * kT), "A.s1").row, kRow + 4);
}

TEST_P(Clock, AReferenceActsOneControllerPeriodLater) {
  const Change c = Of(Step("B.y", "reference", 1e-6, kRow * kT), "B.s1");
  EXPECT_EQ(c.row, kRow + 2);
  EXPECT_NEAR(c.by,
              BaseRig().controller.pid.kp * 1e-6 / kNewtonPerAmpere * std::sin(22.5 * kPi / 180),
              1e-11);
}

// A coil's current excitation is read at every PWM start and acts at once: the duty of that period.
TEST_P(Clock, ACurrentActsAtOnce) {
  const AmplifierParameters a = BaseRig().amplifier;
  const Change c = Of(Step("A.coil1", "current", 0.1, (kRow + 1) * kT), "A.d1");
  EXPECT_EQ(c.row, kRow + 1);
  EXPECT_NEAR(c.by, 0.1 * (a.kp + a.ki * kT) / (2 * a.bus_voltage), 1e-12);
}

// That duty is applied in its own period, whose mean current is the feedback of the next row. The
// flux-free pattern has leakage alone; the coil's own rise is between U/L_l and U/(L_0 + L_l).
TEST_P(Clock, TheDutyIsAppliedInItsOwnPeriod) {
  EXPECT_EQ(Of(Step("A.coil1", "current", 0.1, (kRow + 1) * kT), "A.i1").row, kRow + 2);
}

// A driven duty replaces the current loop for the whole run: nothing outside its time.
TEST_P(Clock, ADutyIsTakenAsItIs) {
  const Excitation e = Step("A.coil1", "duty", 0.61, (kRow + 1) * kT);
  const Record record = Simulated(GetParam(), &e);
  EXPECT_EQ(record.Find("A.d1")->samples[kRow], 0);
  EXPECT_EQ(record.Find("A.d1")->samples[kRow + 1], 0.61);
}

// A delay of five controller periods: a record shows every set-point in its own period, the coils
// get it later. (Set-points under way used to wait for each other in the switching engine.)
TEST(LoopDelay, SetPointsAreRecordedWhenTheyAreDue) {
  RigParameters rig = BaseRig();
  rig.effects.push_back(MakeInstance(*FindEffect("loop-delay"), "rig"));
  rig.effects.back().Set("time", 4e-4);
  Scenario s = BaseScenario("steps", rig);
  s.excitations = {Step("A.x", "force", 0.5, kRow * kT)};
  s.loads.clear();
  s.duration = 0.0025;
  s.record_rate = 25000;
  EngineOptions o;
  o.warm_up = 0.0004;
  const Record with = SwitchingEngine(rig, s, o).Run().record;
  s.excitations.clear();
  const Record without = SwitchingEngine(rig, s, o).Run().record;
  EXPECT_EQ(FirstChange(with, without, "A.s1").row, kRow + 2);
  EXPECT_EQ(FirstChange(with, without, "A.d1").row, kRow + 2 + 10);
}

INSTANTIATE_TEST_SUITE_P(Fidelity, Clock,
                         ::testing::Values(Engine::kSwitching, Engine::kReference,
                                           Engine::kAveraged),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace ambrig
