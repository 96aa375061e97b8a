/// A run that is moved from outside: the bits of the same run by a scenario.
#include "simulation/stepped/stepped_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

RigParameters SteppedRig() {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml");
}

Scenario SteppedScenario(const RigParameters& rig, const std::string& more) {
  return ReadScenarioText(
      "name = \"stepped\"\nduration = 0.06\nrecord_rate = 25000.0\nseed = 3\n" + more, "s.toml",
      rig);
}

/// Largest difference of every channel to the record's, relative to the channel's largest value;
/// set-points and duties are those of the period before.
double LargestDifference(const Record& record, SteppedRun& run,
                         const std::function<void(long long)>& before_period) {
  std::vector<double> values;
  double worst = 0;
  std::vector<double> scale;
  for (const SteppedOutput& o : run.outputs()) {
    const Channel* c = record.Find(o.name);
    double most = 0;
    for (std::size_t k = 0; c && k < c->samples.size(); ++k)
      most = std::max(most, std::abs(c->samples[k]));
    scale.push_back(most > 0 ? most : 1);
  }
  std::size_t compared = 0;
  run.Start();
  for (long long n = 0; n < 1500; ++n) {
    run.Read(values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const SteppedOutput& o = run.outputs()[k];
      const Channel* c = record.Find(o.name);
      const bool of_period =
          o.column.kind == ChannelKind::kSetPoint || o.column.kind == ChannelKind::kDuty;
      if (!c || o.kind != SteppedOutput::Kind::kChannel || (of_period && n == 0)) continue;
      const double wanted = c->samples[static_cast<std::size_t>(of_period ? n - 1 : n)];
      worst = std::max(worst, std::abs(values[k] - wanted) / scale[k]);
      ++compared;
    }
    before_period(n);
    run.Period();
  }
  EXPECT_GT(compared, 1500U * 60U);
  return worst;
}

TEST(SteppedRun, WithoutInputsItIsTheScenarioBitByBit) {
  const RigParameters rig = SteppedRig();
  const Scenario s = SteppedScenario(rig, R"(
[speed]
profile = [[0.0, 100.0], [0.06, 180.0]]
[[excitation]]
target = "A.x"
kind = "step"
amplitude = 3.0
start = 0.004
[[fault]]
time = 0.02
target = "A.coil3"
kind = "open"
)");
  const RunResult run = Simulate(rig, s, {});
  SteppedRun stepped(rig, s);
  EXPECT_EQ(LargestDifference(run.record, stepped, [](long long) {}), 0);
  ASSERT_EQ(run.events.size(), stepped.events().size());
  EXPECT_GE(run.events.size(), 3U);
  for (std::size_t k = 0; k < run.events.size(); ++k) {
    EXPECT_EQ(run.events[k].t, stepped.events()[k].t);
    EXPECT_EQ(run.events[k].kind, stepped.events()[k].kind);
  }
}

TEST(SteppedRun, InputsDoWhatTheScenarioDoes) {
  const RigParameters rig = SteppedRig();
  const Scenario wanted = SteppedScenario(rig, R"(
[speed]
profile = [[0.0, 90.0], [0.032, 90.0], [0.032001, 110.0]]
[[excitation]]
target = "B.y"
port = "reference"
kind = "step"
amplitude = 1e-5
start = 0.008
[[excitation]]
target = "A.coil2"
port = "current"
kind = "pulse"
amplitude = 0.2
start = 0.01
stop = 0.012
[[load]]
plane = "A"
force = [12.0, -5.0]
start = 0.016
stop = 0.024
[[fault]]
time = 0.04
target = "A.coil5"
kind = "partial-short"
parameters = { fraction = 0.3 }
)");
  const RunResult run = Simulate(rig, wanted, {});
  SteppedRun stepped(rig, SteppedScenario(rig, ""));
  stepped.SetSpeed(90, 0);
  const double worst = LargestDifference(run.record, stepped, [&](long long n) {
    if (n == 200) stepped.inputs.reference[3] = 1e-5;
    if (n == 250) stepped.inputs.current[0][1] = 0.2;
    if (n == 300) stepped.inputs.current[0][1] = 0;
    if (n == 400) stepped.inputs.load[0] = {12, -5};
    if (n == 600) stepped.inputs.load[0] = {0, 0};
    if (n == 800) stepped.SetSpeed(110, 0);
    if (n == 1000) stepped.AddFault({0, "A.coil5", "partial-short", {{"fraction", 0.3}}, "test"});
  });
  // Where the instants are the same doubles, as here, the bits are too.
  EXPECT_EQ(worst, 0);
}

/// A fault from outside at the beginning of a period comes before the scenario's own fault at its
/// end.
TEST(SteppedRun, FaultsOfOnePeriodComeInTheOrderOfTime) {
  const RigParameters rig = SteppedRig();
  const std::string last = R"(
[[fault]]
time = 0.020035
target = "B.coil3"
kind = "open"
)",
                    first = R"(
[[fault]]
time = 0.02
target = "A.coil3"
kind = "open"
)";
  const RunResult run = Simulate(rig, SteppedScenario(rig, first + last), {});
  SteppedRun stepped(rig, SteppedScenario(rig, last));
  const double worst = LargestDifference(run.record, stepped, [&](long long n) {
    if (n == 500) stepped.AddFault({0, "A.coil3", "open", {}, "test"});
  });
  EXPECT_EQ(worst, 0);
}

/// Angle and speed of a ramp given as speed and acceleration, over many changes.
TEST(SteppedRun, SpeedAndAngleFollowTheGivenAcceleration) {
  const RigParameters rig = SteppedRig();
  SteppedRun run(rig, SteppedScenario(rig, ""));
  run.SetSpeed(10, 0);
  run.Start();
  std::size_t omega = 0, theta = 0;
  for (std::size_t k = 0; k < run.outputs().size(); ++k) {
    if (run.outputs()[k].name == "omega") omega = k;
    if (run.outputs()[k].name == "theta") theta = k;
  }
  const double T = run.T();
  double speed = 10, angle = 0;
  std::vector<double> values;
  for (int n = 0; n < 400; ++n) {
    const double a = n % 2 == 0 ? 500 : -100;
    run.SetSpeed(speed, a);
    run.Period();
    angle += speed * T + 0.5 * a * T * T;
    speed += a * T;
    run.Read(values);
    EXPECT_NEAR(values[omega], speed, 1e-9);
    EXPECT_NEAR(values[theta], angle, 1e-9);
  }
}

}  // namespace
}  // namespace ambrig
