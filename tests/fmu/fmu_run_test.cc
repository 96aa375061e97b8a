/// FMUs of rigs, in both versions of FMI: the numbers of `ambrig run`, states, parameters,
/// mistakes.
#include <gtest/gtest.h>

#include <cmath>

#include "core/record/channels.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "tests/fmu/exported.h"

namespace ambrig::testing {
namespace {

constexpr double kStep = 8e-5;  // a controller period of the reference rig [s]
constexpr int kSteps = 750;     // 60 ms

class FmuRun : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Versions, FmuRun, ::testing::Values("2.0", "3.0"),
                         [](const auto& version) { return std::string("Fmi") + version.param[0]; });

RunResult Wanted(const RigParameters& rig, const std::string& more) {
  return Simulate(rig,
                  ReadScenarioText("name = \"s\"\nduration = 0.06\nrecord_rate = 25000.0\n" + more,
                                   "s.toml", rig),
                  {});
}

/// Outputs of the FMU against the record, step by step. Set-points and duties are those of the
/// period before.
void ExpectTheRecord(const Importer& fmu, const Record& record,
                     const std::function<void(int)>& before_step) {
  std::size_t compared = 0;
  for (int k = 0; k < kSteps; ++k) {
    for (const Channel& c : record.channels) {
      double scale = 1e-30;
      for (const double v : c.samples) scale = std::max(scale, std::abs(v));
      const bool of_period =
          IsOfKind(c.name, ChannelKind::kSetPoint) || IsOfKind(c.name, ChannelKind::kDuty);
      if (of_period && k == 0) continue;
      const auto row = static_cast<std::size_t>(of_period ? 2 * k - 1 : 2 * k);
      ASSERT_NEAR(fmu.Get(c.name), c.samples[row], 1e-12 * scale) << c.name << " after step " << k;
      ++compared;
    }
    before_step(k);
    ASSERT_EQ(fmu.Step(k * kStep, kStep), 0) << LastMessage();
  }
  EXPECT_GT(compared, 60U * kSteps);
}

TEST_P(FmuRun, GivesTheNumbersOfTheRun) {
  const Exported exported(GetParam());
  const RunResult run = Wanted(ReadRig(exported.rig), R"(
[speed]
profile = [[0.0, 90.0]]
[[excitation]]
target = "B.y"
port = "reference"
kind = "step"
amplitude = 1e-5
start = 0.008
[[excitation]]
target = "A.x"
kind = "step"
amplitude = 4.0
start = 0.016
[[load]]
plane = "A"
force = [12.0, -5.0]
start = 0.024
stop = 0.032
[[fault]]
time = 0.04
target = "A.coil5"
kind = "partial-short"
parameters = { fraction = 0.3 }
)");
  const Importer fmu(exported.fmu);
  EXPECT_EQ(fmu.Set("speed", 90), 0);
  fmu.Initialize();
  ExpectTheRecord(fmu, run.record, [&](int k) {
    if (k == 100) {
      EXPECT_EQ(fmu.Set("reference.B.y", 1e-5), 0);
    }
    if (k == 200) {
      EXPECT_EQ(fmu.Set("force.A.x", 4), 0);
    }
    if (k == 300) {
      EXPECT_EQ(fmu.Set("load.A.x", 12) + fmu.Set("load.A.y", -5), 0);
    }
    if (k == 400) {
      EXPECT_EQ(fmu.Set("load.A.x", 0) + fmu.Set("load.A.y", 0), 0);
    }
    if (k == 500) {
      EXPECT_EQ(fmu.Set("fault.A.coil5.partial-short", 1), 0);
      EXPECT_EQ(fmu.Set("fault.A.coil5.partial-short.fraction", 0.3), 0);
    }
  });
}

TEST_P(FmuRun, StartsFromAScenario) {
  const std::string more =
      "[[fault]]\ntime = 0.02\ntarget = \"A.coil3\"\nkind = \"open\"\n"
      "[speed]\nprofile = [[0.0, 100.0], [0.06, 180.0]]\n";
  const Exported exported(GetParam(), "name = \"s\"\nduration = 0.06\nseed = 5\n" + more);
  const RunResult run = Wanted(ReadRig(exported.rig), "seed = 5\n" + more);
  const Importer fmu(exported.fmu);
  fmu.Initialize();
  EXPECT_EQ(fmu.Get("seed"), 5);
  EXPECT_EQ(fmu.Get("A.in_use3"), 1);
  ExpectTheRecord(fmu, run.record, [](int) {});
  EXPECT_EQ(fmu.Get("A.in_use3"), 0);
  EXPECT_EQ(fmu.Get("A.in_use4"), 1);
  EXPECT_NE(fmu.Get("A.slope4"), 0);
}

TEST_P(FmuRun, ParametersAreThoseOfTheRigFile) {
  const Exported exported(GetParam());
  const RigParameters rig = ReadRigText(
      EditedToml(ReadBytes(exported.rig), "rig.toml",
                 {{"rotor.mass", 5.0}, {"bearings.B.gap", 4.2e-4}, {"controller.kd", 1000.0}}),
      "rig.toml");
  const RunResult run = Wanted(rig, "seed = 9\nnoise = false\n");
  const Importer fmu(exported.fmu);
  EXPECT_EQ(fmu.Get("rotor.mass"), 4.2);
  for (const auto& [name, value] : {std::pair{"rotor.mass", 5.0},
                                    {"bearings.B.gap", 4.2e-4},
                                    {"controller.kd", 1000.0},
                                    {"seed", 9.0},
                                    {"noise", 0.0}})
    EXPECT_EQ(fmu.Set(name, value), 0) << name;
  fmu.Initialize();
  ExpectTheRecord(fmu, run.record, [](int) {});
}

/// Steps with changing inputs from step `from` on; all outputs after each.
std::vector<std::vector<double>> Go(const Importer& fmu, int from, int steps) {
  const std::vector<std::string> names = fmu.Names("output");
  std::vector<std::vector<double>> out;
  for (int k = from; k < from + steps; ++k) {
    EXPECT_EQ(fmu.Set("force.A.y", k % 7 - 3.0), 0);
    EXPECT_EQ(fmu.Set("speed", 50.0 + k % 3), 0);
    if (k == 60) {
      EXPECT_EQ(fmu.Set("fault.A.coil2.open", 1), 0);
    }
    EXPECT_EQ(fmu.Step(k * kStep, kStep), 0) << LastMessage();
    out.push_back(fmu.Values(names));
  }
  return out;
}

TEST_P(FmuRun, AStateComesBackBitByBit) {
  const Exported exported(GetParam());
  const Importer fmu(exported.fmu);
  fmu.Initialize();
  Go(fmu, 0, 50);
  void* state = nullptr;
  const char* const get = fmu.two() ? "GetFMUstate" : "GetFMUState";
  const char* const set = fmu.two() ? "SetFMUstate" : "SetFMUState";
  ASSERT_EQ(fmu.Call<int>(get, fmu.instance, &state), 0);
  const auto first = Go(fmu, 50, 40);
  ASSERT_EQ(fmu.Call<int>(set, fmu.instance, state), 0);
  EXPECT_EQ(Go(fmu, 50, 40), first);

  std::size_t size = 0;
  ASSERT_EQ(fmu.Call<int>(fmu.two() ? "SerializedFMUstateSize" : "SerializedFMUStateSize",
                          fmu.instance, state, &size),
            0);
  std::vector<char> bytes(size);
  ASSERT_EQ(fmu.Call<int>(fmu.two() ? "SerializeFMUstate" : "SerializeFMUState", fmu.instance,
                          state, bytes.data(), size),
            0);
  const Importer other(fmu);
  void* copy = nullptr;
  const char* const read = fmu.two() ? "DeSerializeFMUstate" : "DeserializeFMUState";
  ASSERT_EQ(
      other.Call<int>(read, other.instance, static_cast<const char*>(bytes.data()), size, &copy),
      0);
  ASSERT_EQ(other.Call<int>(set, other.instance, copy), 0);
  EXPECT_EQ(Go(other, 50, 40), first);
  // Bytes that are no state.
  void* wrong = nullptr;
  EXPECT_EQ(other.Call<int>(read, other.instance, static_cast<const char*>(bytes.data()), size - 8,
                            &wrong),
            3);
  bytes[3] = 'x';
  EXPECT_EQ(
      other.Call<int>(read, other.instance, static_cast<const char*>(bytes.data()), size, &wrong),
      3);
  const char* const release = fmu.two() ? "FreeFMUstate" : "FreeFMUState";
  EXPECT_EQ(fmu.Call<int>(release, fmu.instance, &state), 0);
  EXPECT_EQ(state, nullptr);
  EXPECT_EQ(other.Call<int>(release, other.instance, &copy), 0);
}

TEST_P(FmuRun, ResetBeginsAnew) {
  const Exported exported(GetParam());
  const Importer fmu(exported.fmu);
  EXPECT_EQ(fmu.Set("rotor.mass", 5), 0);
  fmu.Initialize();
  const auto heavy = Go(fmu, 0, 20);
  EXPECT_EQ(fmu.Call<int>("Terminate", fmu.instance), 0);
  EXPECT_EQ(fmu.Call<int>("Reset", fmu.instance), 0);
  EXPECT_EQ(fmu.Get("rotor.mass"), 4.2);
  fmu.Initialize();
  const auto light = Go(fmu, 0, 20);
  EXPECT_NE(light, heavy);
  EXPECT_EQ(fmu.Call<int>("Reset", fmu.instance), 0);
  EXPECT_EQ(fmu.Set("rotor.mass", 5), 0);
  fmu.Initialize();
  EXPECT_EQ(Go(fmu, 0, 20), heavy);
}

/// Any communication step: all periods that end by its end.
TEST_P(FmuRun, StepsNeedNotBeWholePeriods) {
  const Exported exported(GetParam());
  const Importer even(exported.fmu), odd(even);
  even.Initialize();
  odd.Initialize();
  const std::vector<std::string> names = even.Names("output");
  double t = 0;
  for (int k = 1; k <= 30; ++k) {
    ASSERT_EQ(odd.Step(t, 2.7e-5), 0);
    t += 2.7e-5;
  }
  for (int k = 0; k < 20; ++k) ASSERT_EQ(even.Step(k * 4e-5, 4e-5), 0);
  EXPECT_EQ(odd.Values(names), even.Values(names));  // 810 us: 20 periods
}

void ExpectError(int status, const std::string& words) {
  EXPECT_EQ(status, 3);
  EXPECT_NE(LastMessage().find(words), std::string::npos) << LastMessage();
}

TEST_P(FmuRun, MistakesAreErrorsWithASentence) {
  const Exported exported(GetParam());
  Importer fmu(exported.fmu);
  Importer wrong(fmu);
  wrong.Call<void>("FreeInstance", wrong.instance);
  wrong.Instantiate("{of another}");
  EXPECT_EQ(wrong.instance, nullptr);
  EXPECT_NE(LastMessage().find("is of another FMU ({of another})"), std::string::npos)
      << LastMessage();
  ExpectError(fmu.Step(0, kStep), "a step is allowed after the initialization");
  ExpectError(fmu.Set("rotor.mass", -1), "rotor.mass = -1 kg, allowed:");
  ExpectError(fmu.Set("A.x", 1), "A.x is no input and no parameter");
  ExpectError(fmu.Set("force.A.x", std::nan("")), "force.A.x = nan N, allowed");
  fmu.Initialize();
  ExpectError(fmu.Set("rotor.mass", 5), "rotor.mass is a parameter");
  ExpectError(fmu.Step(1, kStep), "a step from t = 1 s, allowed: from 0 s");
  ExpectError(fmu.Step(0, -1), "a step of -1 s, allowed: 0 s or more");
  EXPECT_EQ(fmu.Step(0, kStep), 0);
  // A fault by the rules of scenario files.
  EXPECT_EQ(fmu.Set("fault.A.coil1.partial-short", 1), 0);
  ExpectError(fmu.Step(kStep, kStep), "fraction is missing, allowed: above 0 to below 1");
  EXPECT_EQ(fmu.Set("fault.A.coil1.partial-short.fraction", 0.25), 0);
  EXPECT_EQ(fmu.Step(kStep, kStep), 0) << LastMessage();
  // Two parameters that contradict each other.
  Importer other(fmu);
  EXPECT_EQ(other.Set("controller.rate", 12000), 0);
  EXPECT_EQ(other.EnterInitialization(), 0);
  ExpectError(other.ExitInitialization(), "controller.rate = 12000");
}

}  // namespace
}  // namespace ambrig::testing
