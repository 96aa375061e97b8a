// Coils that were given up are looked at again: on plants with effects that the detection does not
// know.
#include "faulttolerance/supervision/coil_probes.h"
#include "tests/effects/effect_rigs.h"
#include "tests/faulttolerance/supervision/supervised_runs.h"

namespace ambrig {
namespace {

/// Hysteresis and a moved sensor, with `cutoff` eddy currents too, watched by a detection that was
/// not commissioned.
RigParameters Strange(double cutoff = kInfinity) {
  RigParameters rig = Rig();
  rig.detection.kind = "commissioned";
  for (const char* bearing : {"A", "B"}) {
    if (std::isfinite(cutoff))
      rig = WithEffect(rig, "eddy-currents", bearing, {{"cutoff", cutoff}});
    rig = WithEffect(rig, "hysteresis", bearing, {{"coercive", 0.02}});
  }
  return WithEffect(rig, "sensor-offset", "A.x", {{"offset", 5e-6}});
}

std::size_t Count(const Outcome& o, const std::string& action, const std::string& reason = "") {
  return static_cast<std::size_t>(
      std::count_if(o.result.actions.begin(), o.result.actions.end(), [&](const CoilAction& a) {
        return a.action == action && (reason.empty() || a.reason == reason);
      }));
}

TEST(SecondLook, ACoilWhoseAmplifierCameBackReturnsAndIsWatchedAgain) {
  const Outcome o = Simulated(Spin(0.1, 157, 3) +
                                  FaultTable(0.02, "A.coil4", "amplifier-off", "duration = 5e-3") +
                                  FaultTable(0.07, "A.coil4", "open"),
                              Strange());
  EXPECT_EQ(Count(o, "probe", "healthy"), 1U);
  EXPECT_EQ(Count(o, "restore"), 1U);
  EXPECT_EQ(Count(o, "disable"), 2U);  // and again when it truly opens
  EXPECT_EQ(o.result.actions[0].coil, "A.coil4");
  EXPECT_LT(o.When("restored"), 0.04);
  EXPECT_GT(o.When("restored"), 0.025);
  EXPECT_EQ(o.Class("A.coil4"), "amplifier-off");
  EXPECT_LT(o.result.metrics.max_orbit.at("A"), 40e-6);
  EXPECT_EQ(o.result.metrics.false_alarms, 0);
}

// Strong eddy currents that nobody commissioned: the look finds no healthy coil. It stays off,
// which does no harm.
TEST(SecondLook, WithoutCommissioningADoubtfulCoilStaysOff) {
  const Outcome o =
      Simulated(Spin(0.1, 157, 3) + FaultTable(0.02, "A.coil4", "amplifier-off", "duration = 5e-3"),
                Strange(3000));
  for (const RunEvent& e : o.result.events)
    if (e.kind == "doubtful") {
      EXPECT_EQ(e.fraction, 0) << e.target;  // no turns are said to be shorted
    }
  EXPECT_LT(o.When("doubtful"), 0.1);
  EXPECT_EQ(Count(o, "disable"), 1U);
  EXPECT_EQ(Count(o, "restore"), 0U);
  EXPECT_LT(o.result.metrics.max_orbit.at("A"), 40e-6);
  EXPECT_EQ(o.result.metrics.false_alarms, 0);
}

TEST(SecondLook, ACoilThatIsTrulyLostStaysOff) {
  for (const char* kind : {"open", "amplifier-off"}) {
    const Outcome o =
        Simulated(Spin(0.09, 157, 3) + FaultTable(0.02, "A.coil4", kind, ""), Strange(3000));
    EXPECT_EQ(Count(o, "disable"), 1U) << kind;
    EXPECT_GE(Count(o, "probe"), 2U) << kind;  // after 10 and 50 ms
    EXPECT_EQ(Count(o, "probe"), Count(o, "probe", "faulty")) << kind;
    EXPECT_EQ(Count(o, "restore"), 0U) << kind;
    EXPECT_LT(o.result.metrics.max_orbit.at("A"), 60e-6) << kind;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << kind;
  }
}

// Where the reading of the current is doubted, and the model too, a test current proves nothing.
TEST(SecondLook, WithoutCommissioningAFalseCurrentSensorIsNotRestored) {
  for (const char* parameters : {"stuck = true", "gain = 0.4"}) {
    const Outcome o =
        Simulated(Spin(0.09, 157, 3) + FaultTable(0.02, "A.coil4", "current-sensor", parameters),
                  Strange(3000));
    EXPECT_EQ(Count(o, "disable"), 1U) << parameters;
    EXPECT_EQ(Count(o, "restore"), 0U) << parameters;
    EXPECT_LT(o.result.metrics.max_orbit.at("A"), 60e-6) << parameters;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << parameters;
  }
}

// The larger of both axes over two slices of 20 ms; nothing is known before the first has passed.
TEST(SecondLook, MotionIsThatOfTheLastSlices) {
  CoilProbes probes;
  for (int k = 0; k < 3000; ++k) {
    const double t = k * 40e-6;
    // off centre throughout, a swing of 30 um until 40 ms
    probes.Orbit(t, 50e-6, t < 0.04 ? -15e-6 * std::cos(300 * t) : 0);
    if (k == 480) {
      EXPECT_EQ(probes.Motion(), kInfinity);
    }
    if (k == 900) {
      EXPECT_NEAR(probes.Motion(), 30e-6, 1e-6);
    }
  }
  EXPECT_EQ(probes.Motion(), 0);
}

TEST(SecondLook, AnActionAfterWhichTheOrbitGrowsIsDoubtedAtOnce) {
  CoilProbes probes;
  double t = 0;
  const auto run = [&](double seconds, double orbit) {
    for (const double end = t + seconds; t < end; t += 40e-6) {
      probes.Orbit(t, orbit, 0);
      if (probes.Due(t) >= 0) return true;
    }
    return false;
  };
  EXPECT_FALSE(run(0.05, 10e-6));
  probes.GivenUp(2, FaultClass::kOpen, t);
  const double given_up = t;
  EXPECT_TRUE(run(0.05, 40e-6));
  EXPECT_NEAR(t - given_up, 2e-3, 1e-4);
  probes.Answer(2, false, t);
  EXPECT_FALSE(run(0.006, 40e-6));
  EXPECT_TRUE(run(0.004, 40e-6));  // the looks of every coil go on as planned
  EXPECT_NEAR(t - given_up, 10e-3, 1e-4);
  probes.Answer(2, false, t);
  EXPECT_FALSE(run(0.035, 40e-6));
  EXPECT_TRUE(run(0.01, 40e-6));
}

// The orbit that grows after a second coil has failed is not the work of the first derating.
TEST(SecondLook, AnOrbitThatGrowsAfterAnotherFaultIsNotThatOfADerating) {
  for (const bool another : {false, true}) {
    CoilProbes probes;
    int worse = -1;
    for (int n = 0; n < 1500; ++n) {
      const double t = n * 40e-6;
      if (n == 1000) probes.Derated(2, t, 200e-6, true);
      if (n == 1100 && another) probes.GivenUp(5, FaultClass::kOpen, t);
      probes.Orbit(t, n < 1150 ? 5e-6 : 60e-6, 0);
      worse = std::max(worse, probes.MadeWorse(t));
    }
    EXPECT_EQ(worse, another ? -1 : 2);
  }
}

TEST(SecondLook, AHealthyCoilReturnsOnceAndASwitchThatStaysOnIsNeverProbed) {
  CoilProbes probes;
  probes.GivenUp(1, FaultClass::kSwitchStuckOn, 0);
  EXPECT_EQ(probes.Due(1), -1);
  probes.GivenUp(3, FaultClass::kOpen, 0);
  EXPECT_EQ(probes.Due(0.005), -1);
  EXPECT_EQ(probes.Due(0.011), 3);
  probes.Answer(3, true, 0.011);
  EXPECT_EQ(probes.Due(1), -1);
  probes.GivenUp(3, FaultClass::kOpen, 1);
  EXPECT_EQ(probes.Due(2), -1);
}

// Without A2 and A4 the currents of A6 and A8 are next to nothing: that they break shows only when
// they are asked for some.
TEST(SecondLook, IdleCoilsThatOpenAreFound) {
  std::string faults;
  for (const auto& [coil, t] : {std::pair{2, 0.02}, {4, 0.03}, {6, 0.04}, {8, 0.05}})
    faults += FaultTable(t, fmt::format("A.coil{}", coil), "open");
  const Outcome o = Simulated(Spin(0.14, 157, 3) + faults, Strange(10000));
  for (const char* target : {"A.coil2", "A.coil4", "A.coil6", "A.coil8"})
    EXPECT_EQ(o.Class(target), "open") << target;
  EXPECT_EQ(o.result.metrics.false_alarms, 0);
  EXPECT_FALSE(o.result.touchdown);
  EXPECT_LT(o.result.metrics.max_orbit.at("A"), 40e-6);
}

// And idle coils that are well stay in use.
TEST(SecondLook, IdleCoilsThatAreWellStayInUse) {
  const std::string faults =
      FaultTable(0.02, "A.coil2", "open") + FaultTable(0.03, "A.coil4", "open");
  const Outcome o = Simulated(Spin(0.14, 157, 3) + faults, Strange(10000));
  EXPECT_EQ(Count(o, "disable"), 2U);
  EXPECT_EQ(o.result.metrics.false_alarms, 0);
  EXPECT_LT(o.result.metrics.max_orbit.at("A"), 40e-6);
}

TEST(SecondLook, IdleCoilsAreAskedAfterTenMillisecondsAndThenNowAndAgain) {
  CoilProbes probes;
  const auto due_at = [&](double t) {
    for (int j : {1, 5}) probes.Idle(j, true, t);
    return probes.Due(t);
  };
  EXPECT_EQ(due_at(0), -1);
  EXPECT_EQ(due_at(0.009), -1);
  EXPECT_EQ(due_at(0.0101), 1);
  probes.AnswerIdle(1, 0.0115);
  EXPECT_EQ(due_at(0.012), -1);  // the others are judged in between
  EXPECT_EQ(due_at(0.02), 5);
  probes.AnswerIdle(5, 0.0215);
  EXPECT_EQ(due_at(0.06), -1);
  EXPECT_EQ(due_at(0.062), 1);
  // One that works again is left alone.
  probes.Idle(1, false, 0.0625);
  probes.Idle(5, false, 0.0625);
  EXPECT_EQ(probes.Due(0.2), -1);
}

// Every coil of a bearing that idles is due after 10 ms, one after the other 8 ms apart, and again
// 50 ms after its own probe.
TEST(CoilProbes, EveryIdleCoilHasItsTurn) {
  CoilProbes probes;
  for (const int coil : {0, 3, 7}) probes.Idle(coil, true, 1.0);
  EXPECT_EQ(probes.Due(1.0099), -1);
  EXPECT_EQ(probes.Due(1.0101), 0);
  probes.AnswerIdle(0, 1.0101);
  EXPECT_EQ(probes.Due(1.018), -1);
  EXPECT_EQ(probes.Due(1.0182), 3);
  probes.AnswerIdle(3, 1.0182);
  EXPECT_EQ(probes.Due(1.0263), 7);
  probes.AnswerIdle(7, 1.0263);
  EXPECT_EQ(probes.Due(1.06), -1);
  EXPECT_EQ(probes.Due(1.0602), 0);
  probes.Idle(0, false, 1.0602);  // it works again
  EXPECT_EQ(probes.Due(1.0603), -1);
  EXPECT_EQ(probes.Due(1.0683), 3);
}

// One current sensor after the other says that the model errs: only the first is acted on, and
// after a probe has refuted it none of another coil.
TEST(CoilProbes, AFalseCurrentMakesThoseOfOtherCoilsSuspect) {
  CoilProbes probes;
  probes.GivenUp(1, FaultClass::kOpen, 0.01);
  EXPECT_FALSE(probes.OtherFalseCurrent(2));  // an open coil says nothing of readings
  probes.GivenUp(3, FaultClass::kCurrentSensor, 0.02);
  EXPECT_TRUE(probes.OtherFalseCurrent(4));
  EXPECT_FALSE(probes.OtherFalseCurrent(3));
  probes.Answer(3, true, 0.03);
  EXPECT_FALSE(probes.FalseCurrent(3));
  EXPECT_TRUE(probes.OtherFalseCurrent(4));
  EXPECT_FALSE(probes.OtherFalseCurrent(3));  // it may truly fail again
}

// A sensor that three probes found wrong is one; another coil's may fail later.
TEST(CoilProbes, ASensorThatStaysWrongLeavesOthersTheirFaults) {
  for (const bool disputed : {false, true}) {
    CoilProbes probes;
    probes.GivenUp(3, FaultClass::kCurrentSensor, 0.02);
    double t = 0.02;
    while (probes.Due(t) != 3) t += 1e-3;
    for (int looks = 0; looks < 3; ++looks) {
      EXPECT_TRUE(probes.OtherFalseCurrent(4)) << looks;
      while (probes.Due(t) != 3) t += 1e-3;
      if (disputed) probes.Dispute(3);  // healthy, but to a detector that doubts its model
      probes.Answer(3, false, t);
    }
    EXPECT_EQ(probes.Due(t + 1), -1);
    EXPECT_EQ(probes.OtherFalseCurrent(4), disputed);
  }
}

}  // namespace
}  // namespace ambrig
