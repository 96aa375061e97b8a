// Predicted frequency responses against sines in the switching engine, and against closed forms.
#include "discovery/model/response_predictor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "analysis/linear/operating_point.h"
#include "core/math/constants.h"
#include "tests/discovery/model/response_cases.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
using testing::AxisCase;
using testing::CaseOf;
using testing::ExpectNearSines;
using testing::kNear;
using testing::SineRun;
using testing::TemporaryFolder;
using testing::Trace;
using testing::With;
using testing::WriteBytes;

TEST(ResponsePredictor, FollowsSinesInTheSwitchingEngine) {
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {20, 60, 150, 400, 1100});
  ExpectNearSines(c.rig, c);
}

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
