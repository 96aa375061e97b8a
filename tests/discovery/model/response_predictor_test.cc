// Predicted frequency responses against sines in the switching engine, and against closed forms.
#include "discovery/model/response_predictor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "analysis/linear/operating_point.h"
#include "core/math/constants.h"
#include "discovery/model/multisine_response.h"
#include "effects/catalogue.h"
#include "tests/discovery/bench_case.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
using testing::CaseOf;
using testing::SineRun;
using testing::TemporaryFolder;
using testing::WriteBytes;

/// A file of responses at these frequencies; what stands in it plays no part here.
std::string Trace(const TemporaryFolder& folder, const std::vector<double>& frequencies) {
  std::string text = "f [Hz],Re(trace),Im(trace)\n";
  for (const double f : frequencies) text += fmt::format("{},1,0\n", f);
  WriteBytes(folder.File("trace.csv"), text);
  return "trace.csv";
}

EffectInstance With(const std::string& effect, const std::string& target,
                    const std::string& parameter, double value) {
  EffectInstance e = MakeInstance(EffectNamed(effect), target);
  e.Set(parameter, value);
  return e;
}

constexpr double kNear = 0.02;  // as the linear model against sines, docs/theory/linearisation.md

/// What a small force on A.x does to the reading and to the set-points of that axis.
struct MeasuredAxis {
  Complex compliance, set_point;
};

MeasuredAxis SinesOf(const RigParameters& rig, double f, double amplitude) {
  SineRun run{rig, {}};
  run.sine.target = "A.x";
  run.sine.port = "force";
  run.sine.frequency = f;
  run.sine.amplitude = amplitude;
  return {run.Response({{"A.x", 1}}), run.Response({{"A.s1", 1}})};
}

void ExpectNearSines(const RigParameters& rig, const Case& c) {
  const ResponsePredictor predictor(c, c.records[0]);
  const auto H = predictor.Respond(rig);
  ASSERT_EQ(H.size(), 2u);
  const auto &set_point = H[0], &reading = H[1];  // by name: A.s1 before A.x
  const std::vector<double>& f = c.records[0].responses.frequency;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const MeasuredAxis measured = SinesOf(rig, f[k], 0.1);
    EXPECT_LT(std::abs(reading[k] - measured.compliance), kNear * std::abs(reading[k]))
        << f[k] << " Hz: " << reading[k] << " measured " << measured.compliance;
    EXPECT_LT(std::abs(set_point[k] - measured.set_point), kNear * std::abs(set_point[k]))
        << f[k] << " Hz: " << set_point[k] << " measured " << measured.set_point;
  }
}

Case AxisCase(const TemporaryFolder& folder, const std::vector<double>& frequencies) {
  const std::string file = Trace(folder, frequencies);
  return CaseOf(folder,
                "[[record]]\nkind = \"frf\"\ndata = \"" + file +
                    "\"\n[record.responses]\n\"A.x/A.x.force\" = { trace = \"trace\", unit = "
                    "\"m/N\" }\n\"A.s1/A.x.force\" = { trace = \"trace\", unit = \"A/N\" }\n");
}

TEST(ResponsePredictor, FollowsSinesInTheSwitchingEngine) {
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {20, 60, 150, 400, 1100});
  ExpectNearSines(c.rig, c);
}

class EffectInResponses : public ::testing::TestWithParam<std::tuple<EffectInstance, bool>> {};

// In the linear model, or through the simulated multisine, on a grid of its own.
TEST_P(EffectInResponses, FollowsSinesInTheSwitchingEngine) {
  const auto& [effect, linear] = GetParam();
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {23, 71, 180, 410, 900});
  RigParameters rig = c.rig;
  rig.effects = {effect};
  EXPECT_EQ(InLinearModel(c.rig, effect), linear);
  ExpectNearSines(rig, c);
}

INSTANTIATE_TEST_SUITE_P(
    Effects, EffectInResponses,
    ::testing::Values(std::tuple{With("eddy-currents", "A", "cutoff", 1500), true},
                      std::tuple{With("sensor-lowpass", "A", "cutoff", 1200), true},
                      std::tuple{With("sensor-gain", "A.x", "gain", 1.15), true},
                      std::tuple{With("sensor-rotation", "A", "angle", 0.15), true},
                      std::tuple{With("sensor-offset", "A.x", "offset", 4e-5), true},
                      std::tuple{With("current-sensor-gain", "A", "gain", 0.85), true},
                      std::tuple{With("current-sensor-offset", "A.coil1", "offset", 0.15), true},
                      std::tuple{With("iron-reluctance", "A", "path", 3e-5), true},
                      std::tuple{With("saturation", "A", "knee", 0.5), true},
                      std::tuple{With("dead-time", "A", "time", 1e-6), true},
                      std::tuple{With("amplifier-offset", "A", "offset", 2), true},
                      std::tuple{With("hysteresis", "A", "coercive", 0.05), false}),
    [](const auto& one) {
      std::string name = std::get<0>(one.param).name;
      std::ranges::replace(name, '-', '_');
      return name;
    });

// A delay and a bending mode are in the linear model itself.
TEST(ResponsePredictor, DelayAndBendingAreLinear) {
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {40, 120, 300, 700});
  const EffectInstance delay = With("loop-delay", "rig", "time", 8e-5);
  EXPECT_TRUE(InLinearModel(c.rig, delay));
  RigParameters rig = c.rig;
  rig.effects = {delay};
  ExpectNearSines(rig, c);
}

// No effect at all, a null one and one that is next to nothing: no jump between the two ways.
TEST(ResponsePredictor, NoJumpWhereTheSimulatedTestBegins) {
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {20, 60, 150, 400, 1100});
  const ResponsePredictor predictor(c, c.records[0]);
  RigParameters rig = c.rig;
  const auto plain = predictor.Respond(rig);
  rig.effects = {With("hysteresis", "A", "coercive", 1e-7)};
  const auto tiny = predictor.Respond(rig);
  ASSERT_EQ(tiny.size(), 2u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_LT(std::abs(tiny[0][k] / plain[0][k] - 1.0), 2e-3);
}

// A pole of the controller on the wrong side: such a rig cannot have been measured.
TEST(ResponsePredictor, AnUnstableLoopHasNoResponse) {
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {20, 60});
  RigParameters rig = c.rig;
  rig.effects = {With("loop-delay", "rig", "time", 2e-3)};
  std::vector<std::vector<double>> columns;
  EXPECT_FALSE(ResponsePredictor(c, c.records[0]).Predict(rig, columns));
}

// The quotient of two outputs does not hang on which of them is the port: plant = compliance / S.
TEST(ResponsePredictor, PlantIsTheQuotientOfTwoOutputs) {
  const TemporaryFolder folder;
  const Case c = CaseOf(
      folder, "[[record]]\nkind = \"frf\"\ndata = \"" + Trace(folder, {30, 200, 800}) +
                  "\"\n[record.responses]\n"
                  "\"A.x/A.x.command\" = { trace = \"trace\", unit = \"m/N\" }\n"
                  "\"A.x/A.x.force\" = { trace = \"trace\", unit = \"m/N\" }\n"
                  "\"A.x.command/A.x.force\" = \"trace\"\n\"A.x.error/A.x.reference\" = \"trace\"\n"
                  "\"A.x/A.x.reference\" = \"trace\"\n");
  const auto H = ResponsePredictor(c, c.records[0]).Respond(c.rig);
  ASSERT_EQ(H.size(), 5u);
  const auto at = [&](const std::string& name, std::size_t k) {
    const auto& all = c.records[0].responses.responses;
    for (std::size_t r = 0; r < all.size(); ++r)
      if (all[r].name() == name) return H[r][k];
    throw std::runtime_error(name);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Complex plant = at("A.x/A.x.command", k);
    EXPECT_LT(std::abs(plant - at("A.x/A.x.force", k) / at("A.x.command/A.x.force", k)),
              1e-9 * std::abs(plant));
    // error = reference - reading
    EXPECT_LT(std::abs(at("A.x.error/A.x.reference", k) + at("A.x/A.x.reference", k) - 1.0), 1e-9);
  }
}

// Current loop of a held coil against sines, with what the linear model holds and does not hold.
TEST(ResponsePredictor, CurrentLoopOfAHeldRotor) {
  const TemporaryFolder folder;
  WriteBytes(
      folder.File("held.toml"),
      fmt::format("name = \"held\"\nrig = \"{}\"\nduration = 0.1\nrecord_rate = 12500.0\n"
                  "[start]\nstate = \"clamped\"\nposition = {{ A = [4e-5, -2e-5], B = [0, 0] "
                  "}}\n[[excitation]]\ntarget = \"A.coil1\"\nport = \"current\"\nkind = "
                  "\"step\"\namplitude = 1.2\n",
                  testing::kSpindle));
  const Case c = CaseOf(folder, "[[record]]\nkind = \"frf\"\nscenario = \"held.toml\"\ndata = \"" +
                                    Trace(folder, {50, 300, 900, 2500}) +
                                    "\"\n[record.responses]\n\"A.i1/A.s1\" = \"trace\"\n");
  const ResponsePredictor predictor(c, c.records[0]);
  for (const bool iron : {false, true}) {
    RigParameters rig = c.rig;
    if (iron) rig.effects = {With("eddy-currents", "A", "cutoff", 800)};
    const auto H = predictor.Respond(rig);
    ASSERT_EQ(H.size(), 1u);
    for (std::size_t k = 0; k < 4; ++k) {
      SineRun run{rig, {}, c.records[0].scenario, 0.1};
      run.scenario.excitations[0].stop = 10;
      run.sine.target = "A.coil1";
      run.sine.port = "current";
      run.sine.frequency = c.records[0].responses.frequency[k];
      run.sine.amplitude = 0.02;
      const Complex measured = run.Response({{"A.i1", 1}});
      EXPECT_LT(std::abs(H[0][k] - measured), kNear * std::abs(measured))
          << run.sine.frequency << " Hz: " << H[0][k] << " measured " << measured;
    }
  }
}

// A coil that is held at a current rests at the duty of its copper's voltage.
TEST(LinearResponses, AHeldCoilRestsAtTheDutyOfItsCopper) {
  const RigParameters rig = ReadRig(testing::kSpindle);
  Scenario held;
  held.start = StartState::kClamped;
  held.duration = 0.1;
  Excitation step;
  step.target = "A.coil1";
  step.port = "current";
  step.kind = "step";
  step.amplitude = 1.2;
  step.stop = 10;
  held.excitations = {step};
  const LinearResponses responses(rig, rig, held);
  const CoilPoint& coil = responses.point().coils[0][0];
  EXPECT_NEAR(coil.current, 1.2, 1e-12);
  // by hand: on for d T at U - 2 U_s, off at -(U + 2 U_d)
  const AmplifierParameters& a = rig.amplifier;
  const double up = a.bus_voltage - 2 * a.switch_drop, down = a.bus_voltage + 2 * a.diode_drop;
  const double volts = 1.2 * CoilResistance(rig.bearings[0]);
  EXPECT_NEAR(coil.duty, (volts + down) / (up + down), 1e-12);
}

// A multisine on the simulated rig measures, without any quotient of models, what the linear model
// says; a command is in force, and in the record, one period after it was computed.
TEST(MultisineMeasurement, MeasuresTheForceCommandOfTheSetPoints) {
  const TemporaryFolder folder;
  const Case c =
      CaseOf(folder, "[[record]]\nkind = \"frf\"\ndata = \"" + Trace(folder, {40, 150, 400}) +
                         "\"\n[record.responses]\n\"A.x.command/A.x.force\" = \"trace\"\n");
  const CaseRecord& record = c.records[0];
  const RigResponse& response = record.responses.responses[0];
  const LinearResponses linear(c.rig, c.rig, record.scenario);
  const MultisineMeasurement test(c.rig, record, response.excited, linear);
  const auto measured = test.Run(c.rig);
  ASSERT_TRUE(measured);
  ASSERT_EQ((*measured)[0].size(), test.lines().size());
  for (std::size_t k = 0; k < test.lines().size(); ++k) {
    const double period = 1 / c.rig.controller.rate;
    const Complex H = linear.At(test.lines()[k], {response})[0] *
                      std::polar(1.0, -2 * kPi * test.lines()[k] * period);
    EXPECT_LT(std::abs((*measured)[0][k] - H), 0.05 * std::abs(H))
        << test.lines()[k] << " Hz: " << H << " measured " << (*measured)[0][k];
  }
}

// A current loop makes of a false reading another current, which the linear model knows; where none
// is fed back, errors of bridges are errors of the current.
TEST(ResponsePredictor, ErrorsOfCurrentsAreLinearUnderACurrentLoopOnly) {
  RigParameters rig = ReadRig(testing::kSpindle);
  const auto linear = [&] {
    std::set<bool> out;
    for (int j = 1; j <= rig.bearings[0].coils(); ++j) {
      const std::string coil = fmt::format("A.coil{}", j);
      for (const EffectInstance& e : {With("current-sensor-gain", coil, "gain", 1.05),
                                      With("current-sensor-offset", coil, "offset", 0.05),
                                      With("amplifier-offset", coil, "offset", 0.5)})
        out.insert(InLinearModel(rig, e));
    }
    return out;
  };
  EXPECT_EQ(linear(), std::set<bool>{true});
  rig.amplifier.voltage_mode = true;
  EXPECT_EQ(linear(), std::set<bool>{false});
}

// The same for responses that a reference is part of.
TEST(ResponsePredictor, NoJumpWhereAReferenceIsThePort) {
  const TemporaryFolder folder;
  const Case c =
      CaseOf(folder, "[[record]]\nkind = \"frf\"\ndata = \"" + Trace(folder, {20, 150, 400}) +
                         "\"\n[record.responses]\n\"A.x.error/A.x.reference\" = \"trace\"\n"
                         "\"A.x/A.x.reference\" = \"trace\"\n");
  const ResponsePredictor predictor(c, c.records[0]);
  RigParameters rig = c.rig;
  const auto plain = predictor.Respond(rig);
  rig.effects = {With("hysteresis", "A", "coercive", 1e-7)};
  const auto tiny = predictor.Respond(rig);
  ASSERT_EQ(tiny.size(), 2u);
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(std::abs(tiny[r][k] - plain[r][k]), 5e-3 * (0.1 + std::abs(plain[r][k])))
          << r << " " << k;
}

// Two coils of a held rotor share their flux: each response is that of its own pair.
TEST(ResponsePredictor, CurrentLoopsOfTwoHeldCoils) {
  const TemporaryFolder folder;
  std::string text = fmt::format(
      "name = \"held\"\nrig = \"{}\"\nduration = 0.1\nrecord_rate = 12500.0\n"
      "[start]\nstate = \"clamped\"\nposition = {{ A = [4e-5, -2e-5], B = [0, 0] }}\n",
      testing::kSpindle);
  for (const int coil : {1, 2})
    text += fmt::format(
        "[[excitation]]\ntarget = \"A.coil{}\"\nport = \"current\"\nkind = \"step\"\n"
        "amplitude = 1.2\n",
        coil);
  WriteBytes(folder.File("held.toml"), text);
  const Case c = CaseOf(folder, "[[record]]\nkind = \"frf\"\nscenario = \"held.toml\"\ndata = \"" +
                                    Trace(folder, {300, 2000}) +
                                    "\"\n[record.responses]\n\"A.i1/A.s1\" = \"trace\"\n");
  const auto H = ResponsePredictor(c, c.records[0]).Respond(c.rig);
  for (std::size_t k = 0; k < 2; ++k) {
    SineRun run{c.rig, {}, c.records[0].scenario, 0.1};
    for (Excitation& e : run.scenario.excitations) e.stop = 10;
    run.sine.target = "A.coil1";
    run.sine.port = "current";
    run.sine.frequency = c.records[0].responses.frequency[k];
    run.sine.amplitude = 0.02;
    const Complex measured = run.Response({{"A.i1", 1}});
    EXPECT_LT(std::abs(H[0][k] - measured), kNear * std::abs(measured)) << run.sine.frequency;
  }
}

}  // namespace
}  // namespace ambrig
