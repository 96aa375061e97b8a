/// Commissioned detectors on plants that are not their model: the switching engine with effects.
#include "simulation/commissioning/commission.h"

#include <gtest/gtest.h>

#include "fdd/commissioned/commissioned_detector.h"
#include "fdd/detectors/detection_feed.h"
#include "tests/effects/effect_rigs.h"
#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

/// Detectors of all bearings beside a run; none acts.
class Onlooker : public Supervisor {
 public:
  Onlooker(const NominalRig& rig, const CommissionedModel& model) : feed_(rig) {
    for (const BearingParameters& b : rig->bearings) {
      const LinkageModel m = LinkageModelOf(b);
      const CommissionedBearing* found = model.Find(b.name);
      watch_.push_back(std::make_unique<CommissionedDetector>(
          CoilDetectorSetup{m, DetectorSettingsOf(rig, b, m)},
          found ? *found : NominalBearing(b.name, m)));
    }
  }
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput&) override {
    feed_.Read(m);
    for (std::size_t k = 0; k < watch_.size(); ++k) {
      MeasuredPeriod in = feed_.Period(k, m);
      in.set_point = &control[k].commanded;
      const auto seen = watch_[k]->Watch(in);
      if (!seen.decided) continue;
      ++decisions;
      if (decisions > 1) continue;
      bearing = k;
      first = seen.diagnosis;
    }
  }
  int decisions = 0;
  std::size_t bearing = 0;
  Diagnosis first;

 private:
  DetectionFeed feed_;
  std::vector<std::unique_ptr<CommissionedDetector>> watch_;
};

std::string Operation(const std::string& fault = "") {
  return testing_plant::Operation(fault, 0.05);
}

std::string FaultText(const std::string& what) {
  return "[[fault]]\ntarget = \"A.coil3\"\ntime = 0.0300123\n" + what;
}

constexpr double kFault = 0.0300123;

std::unique_ptr<Onlooker> Watched(const RigParameters& rig, const CommissionedModel& model,
                                  const std::string& text) {
  const Scenario scenario = ReadScenarioText(text, "operation.toml", rig);
  auto onlooker = std::make_unique<Onlooker>(NominalRig(rig), model);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = onlooker.get();
  SwitchingEngine(rig, scenario, engine).Run();
  return onlooker;
}

class CommissionedPlant : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    rig = WithEffect(ReferenceRig(), "eddy-currents", "A", {{"cutoff", 1000}});
    rig = WithEffect(rig, "sensor-offset", "A.x", {{"offset", 1e-5}});
    CommissioningOptions options;
    options.plan.duration = 0.2;
    model = Commission(rig, options).model;
  }
  static RigParameters rig;
  static CommissionedModel model;
};
RigParameters CommissionedPlant::rig;
CommissionedModel CommissionedPlant::model;

TEST_F(CommissionedPlant, EddyCurrentsAreLearntAndHarmNothing) {
  ASSERT_TRUE(model.Find("A")->usable());
  EXPECT_LT(model.Find("A")->grade, 1);
  // The residues carry the iron: a half-order law at 1 kHz has sqrt(f/1 kHz) at 120 kHz.
  EXPECT_GT(model.Find("A")->circuit.relaxation[3], 3);
  EXPECT_EQ(Watched(rig, model, Operation())->decisions, 0);
}

TEST_F(CommissionedPlant, AnOpenCoilIsFoundWithinAQuarterMillisecond) {
  const auto seen = Watched(rig, model, Operation(FaultText("kind = \"open\"\n")));
  ASSERT_GT(seen->decisions, 0);
  EXPECT_EQ(seen->bearing, 0U);
  EXPECT_EQ(seen->first.coil, 2);
  EXPECT_EQ(seen->first.cls, FaultClass::kOpen);
  EXPECT_LT(seen->first.time - kFault, 0.25e-3);
  EXPECT_GT(seen->first.time, kFault);
}

TEST_F(CommissionedPlant, ShortsAreFoundWithTheirShareOfTheTurns) {
  for (const double share : {0.5, 0.1}) {
    const auto seen =
        Watched(rig, model,
                Operation(FaultText("kind = \"partial-short\"\nparameters = { fraction = " +
                                    std::to_string(share) + " }\n")));
    ASSERT_GT(seen->decisions, 0) << share;
    EXPECT_EQ(seen->first.coil, 2) << share;
    EXPECT_EQ(seen->first.cls, FaultClass::kPartialShort) << share;
    EXPECT_NEAR(seen->first.fraction, share, 0.04) << share;
    EXPECT_LT(seen->first.time - kFault, 0.5e-3) << share;
  }
}

TEST_F(CommissionedPlant, WithoutCommissioningNothingIsDoneToAHealthyMachine) {
  EXPECT_EQ(Watched(rig, {}, Operation())->decisions, 0);
  const auto open = Watched(rig, {}, Operation(FaultText("kind = \"open\"\n")));
  ASSERT_GT(open->decisions, 0);
  EXPECT_EQ(open->first.coil, 2);
  EXPECT_LT(open->first.time - kFault, 0.5e-3);
}

// Leakage past the rotor and fringing into it look alike in all that a healthy machine does but in
// the currents that move the rotor's potential: without them half of the leakage is taken for
// fringing.
TEST(Commission, LeakageIsToldFromFringing) {
  const RigParameters rig = ReferenceRig();
  const double leakage = rig.Find("A")->radial.leakage_inductance;
  const CommissioningResult learnt = Commission(rig, {});
  for (const char* name : {"A", "B"})
    for (int j = 0; j < kLanes; ++j)
      EXPECT_NEAR(learnt.model.Find(name)->coils.leakage[j], leakage, 0.2 * leakage) << name << j;
}

TEST(Commission, AMachineThatTouchesInItsRunIsRefused) {
  CommissioningOptions options;
  options.plan.circle = 0.9;
  EXPECT_THROW(Commission(ReferenceRig(), options), InputError);
}

// No smaller signal helps a rotor that its magnets cannot carry.
TEST(Commission, AMachineThatItsLoopDoesNotHoldIsToldSo) {
  RigParameters rig = ReferenceRig();
  rig.rotor.mass = 100;
  try {
    Commission(rig, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("its loop does not hold it"), std::string::npos)
        << e.what();
  }
}

/// c1, s1, c2 of a surface that is not round; y sees it a quarter of a turn later.
constexpr double kC1 = 1.4e-5, kS1 = 1.4e-5, kC2 = 5e-6;

RigParameters WithRunOut() {
  return WithEffect(ReferenceRig(), "sensor-runout", "A", {{"c1", kC1}, {"s1", kS1}, {"c2", kC2}});
}

// Run-out of 20 um is 5 % of the gap and would be an error of 0.1 in the slopes.
// Four samples a period leave no slope of a phase: nothing is learnt, and nothing must look as if.
TEST(Commission, ARigWithTooFewSamplesIsRefused) {
  RigParameters rig = ReferenceRig();
  rig.amplifier.adc_samples_per_period = 4;
  EXPECT_THROW(Commission(rig, {}), InputError);
}

TEST(Commission, RunOutOfThePositionSensorsIsLearnt) {
  const RigParameters rig = WithRunOut();
  const CommissionedModel model = Commission(rig, {}).model;
  const CommissionedBearing& a = *model.Find("A");
  EXPECT_LT(a.grade, 1);
  const double near = 1e-6, x[] = {kC1, -kS1, kC2, 0}, y[] = {kS1, kC1, -kC2, 0};
  for (std::size_t k = 0; k < kRunOutTerms; ++k) {
    EXPECT_NEAR(a.circuit.run_out.x[k], x[k], near) << k;
    EXPECT_NEAR(a.circuit.run_out.y[k], y[k], near) << k;
  }
  EXPECT_TRUE(model.Find("B")->circuit.run_out.none());
  EXPECT_EQ(Watched(rig, model, Operation())->decisions, 0);
  const auto seen =
      Watched(rig, model,
              Operation(FaultText("kind = \"partial-short\"\nparameters = { fraction = 0.1 }\n")));
  ASSERT_GT(seen->decisions, 0);
  EXPECT_EQ(seen->first.coil, 2);
  EXPECT_EQ(seen->first.cls, FaultClass::kPartialShort);
  EXPECT_LT(seen->first.time - kFault, 0.5e-3);
}

// A shaft that stands still shows a zero of the sensors, no run-out.
TEST(Commission, NoRunOutIsLearntOfAShaftThatDoesNotTurn) {
  CommissioningOptions options;
  options.plan.speed = 0;
  const CommissionedBearing a = *Commission(WithRunOut(), options).model.Find("A");
  EXPECT_TRUE(a.circuit.run_out.none());
  EXPECT_NEAR(a.circuit.dx, kC1 + kC2, 3e-6);
  EXPECT_NEAR(a.circuit.dy, kS1 - kC2, 3e-6);
}

}  // namespace
}  // namespace ambrig
