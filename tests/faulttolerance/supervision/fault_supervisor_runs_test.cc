// Detection and redistribution in whole runs: what is no fault, faults in sequence, touchdowns.
#include "tests/faulttolerance/supervision/supervised_runs.h"

namespace ambrig {
namespace {

TEST(FaultSupervisor, NoAlarmWhileHealthy) {
  // Whirl at 60 % of the clearance, load steps and a run-up; rigs drawn from their tolerances.
  double coil_periods = 0;
  for (unsigned k = 0; k < 3; ++k) {
    std::string s = fmt::format(
        "duration = 0.3\nseed = {}\n[speed]\nprofile = [[0.0, 0.0], [0.3, 1257.0]]\n", k);
    for (const char* axis : {"A.x", "A.y", "B.x", "B.y"})
      s += fmt::format(
          "[[excitation]]\ntarget = \"{}\"\nport = \"reference\"\nkind = \"sine\"\nfrequency = "
          "40.0\n"
          "phase = {}\namplitude = 8e-5\nstart = 0.02\nstop = 0.3\n",
          axis, axis[2] == 'x' ? 1.5708 : 0.0);
    s += "[[load]]\nplane = \"A\"\nforce = [6.0, -8.0]\nstart = 0.1\nstop = 0.2\n";
    const Outcome o = Simulated(s, Drawn(k, k == 0 ? 0 : 1));
    EXPECT_GT(o.result.metrics.max_orbit.at("A"), 1.1e-4);  // the whirl is there
    EXPECT_EQ(o.When("detected"), kInfinity) << k;
    coil_periods += o.coil_periods;
  }
  EXPECT_GT(coil_periods, 4e5);
}

TEST(FaultSupervisor, NoAlarmFromRestOverTouchdownsNorFromABusThatMoves) {
  const Outcome lift = Simulated("duration = 0.2\n[start]\nstate = \"resting\"\n", Drawn(11, 1));
  EXPECT_EQ(lift.When("detected"), kInfinity);
  const Outcome sag = Simulated(
      Spin(0.08, 157, 3) + FaultTable(0.02, "rig", "bus-sag", "voltage = 22.0, duration = 0.02"),
      Rig());
  EXPECT_EQ(sag.Class("rig"), "bus-sag");
  EXPECT_EQ(sag.result.metrics.false_alarms, 0);
}

TEST(FaultSupervisor, StuckPositionSensorIsNotBlamedOnACoil) {
  const Outcome o = Simulated(
      Spin(0.03, 157, 3) + FaultTable(0.02, "A.x", "position-sensor", "stuck = true"), Rig());
  EXPECT_EQ(o.Class("A.x"), "position-sensor");
  EXPECT_EQ(o.result.metrics.false_alarms, 0);
}

// Issue 2: every single open and 50 % short, without touchdown; opens within 40 um. All of A and B
// at three speeds: bench of the campaign; here the eight coils of A at 1500 rpm.
TEST(FaultSupervisor, SurvivesEverySingleOpenAndHalfShort) {
  for (const char* kind : {"open", "partial-short"})
    for (int coil = 1; coil <= 8; ++coil) {
      const std::string target = fmt::format("A.coil{}", coil);
      const Outcome o = Simulated(
          Spin(0.06, 157, static_cast<unsigned>(coil)) +
              FaultTable(0.01, target, kind, kind == std::string("open") ? "" : "fraction = 0.5"),
          Rig());
      EXPECT_EQ(o.Class(target), kind);
      EXPECT_FALSE(o.result.touchdown) << target;
      EXPECT_LT(o.result.metrics.max_orbit.at("A"), 40e-6) << target;
      EXPECT_LT(o.result.metrics.redistribution_delay, 0.4e-3) << target;
      EXPECT_EQ(o.result.metrics.false_alarms, 0) << target;
    }
}

// The two windings of a side carry one flux: the one that failed is named, and the other stays in
// use.
TEST(FaultSupervisor, OfAThrustSideTheWindingThatFailedIsNamedAlone) {
  for (const bool commissioned : {true, false})
    for (int coil = 1; coil <= 4; ++coil) {
      const std::string target = fmt::format("Z.coil{}", coil);
      RigParameters rig = Rig();
      if (!commissioned) rig.detection.commissioning = "none";
      const Outcome o = Simulated(Spin(0.06, 157, static_cast<unsigned>(coil)) +
                                      FaultTable(0.01, target, "partial-short", "fraction = 0.5"),
                                  rig);
      EXPECT_EQ(o.Class(target), "partial-short") << commissioned;
      EXPECT_EQ(o.result.metrics.false_alarms, 0) << target << commissioned;
      EXPECT_FALSE(commissioned && o.result.touchdown) << target;
    }
}

TEST(FaultSupervisor, FaultsInSequenceInAllBearings) {
  const Outcome o = Simulated(Spin(0.1, 1257, 5) + FaultTable(0.02, "A.coil3", "open") +
                                  FaultTable(0.04, "A.coil6", "partial-short", "fraction = 0.3") +
                                  FaultTable(0.06, "B.coil1", "amplifier-off") +
                                  FaultTable(0.08, "Z.coil1", "open"),
                              Rig());
  EXPECT_EQ(o.Class("A.coil3"), "open");
  EXPECT_EQ(o.Class("A.coil6"), "partial-short");
  EXPECT_EQ(o.Class("B.coil1"), "amplifier-off");
  EXPECT_EQ(o.Class("Z.coil1"), "open");
  EXPECT_FALSE(o.result.touchdown);
  EXPECT_EQ(o.result.metrics.false_alarms, 0);
}

// The coil with the false sensor is switched off: what its sensor says no longer spoils the flux
// that the next fault is judged by (a short of 30 % was taken for 45 %, a gain of 0.8 for a short).
TEST(FaultSupervisor, AFaultAfterAFalseSensorIsJudgedWithoutIt) {
  struct Second {
    const char *kind, *parameters;
  };
  unsigned seed = 1;
  for (const char* first : {"offset = 0.3", "stuck = true", "gain = 0.8"})
    for (const Second& second :
         {Second{"partial-short", "fraction = 0.3"}, Second{"current-sensor", "gain = 0.8"},
          Second{"current-sensor", "offset = 0.3"}, Second{"open", ""}}) {
      ++seed;
      const Outcome o =
          Simulated(Spin(0.06, 157, seed) + FaultTable(0.02, "A.coil2", "current-sensor", first) +
                        FaultTable(0.05, "A.coil5", second.kind, second.parameters),
                    Drawn(seed, 1));
      const std::string what = std::string(first) + ", " + second.kind + " " + second.parameters;
      EXPECT_EQ(o.Class("A.coil2"), "current-sensor") << what;
      EXPECT_EQ(o.Class("A.coil5"), second.kind) << what;
      EXPECT_EQ(o.result.metrics.false_alarms, 0) << what;
      EXPECT_LT(o.result.metrics.detection_delay, 0.2e-3) << what;
      if (std::string(second.kind) == "partial-short") {
        EXPECT_NEAR(o.Fraction("A.coil5"), 0.3, 0.03) << what;
      }
    }
}

// 18 A in a coil whose reading is clipped at 10 A tear the shaft to the stator within 1.6 ms: what
// the reading hides, times the speed of the gap, is no fault of the neighbours.
TEST(FaultSupervisor, ASwitchStuckOnIsNotBlamedOnANeighbour) {
  for (int coil = 1; coil <= 8; ++coil) {
    const std::string target = fmt::format("A.coil{}", coil);
    const Outcome o = Simulated(Spin(0.0218, 157, static_cast<unsigned>(coil)) +
                                    FaultTable(0.0200077, target, "switch-stuck-on"),
                                Rig());
    EXPECT_TRUE(o.result.touchdown) << target;
    EXPECT_EQ(o.Class(target), "switch-stuck-on");
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << target;
  }
}

// scenarios/campaigns/stuck_switch.toml in small: what the rotor does after it was torn to the
// stator is no fault of healthy coils and sensors. (Half of these runs blamed one: the velocity of
// an impact is not in the readings before it.)
TEST(FaultSupervisor, ARotorThatBouncesIsNotBlamedOnHealthyCoils) {
  struct Run {
    const char* target;
    double Omega;
    unsigned seed;
  };
  for (const Run& r :
       {Run{"A.coil3", 1256.64, 1}, Run{"A.coil6", 1256.64, 2}, Run{"A.coil1", 0, 3},
        Run{"A.coil5", 157.08, 4}, Run{"B.coil4", 157.08, 5}, Run{"B.coil7", 1256.64, 6}}) {
    const Outcome o = Simulated(
        Spin(0.12, r.Omega, r.seed) + FaultTable(0.02, r.target, "switch-stuck-on"), Rig());
    EXPECT_EQ(o.Class(r.target), "switch-stuck-on");
    EXPECT_TRUE(o.result.drop) << r.target;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << r.target << " at " << r.Omega;
  }
}

// Blows throw the shaft against its auxiliary bearings; at 60 000 rpm the friction drives it round
// them.
TEST(FaultSupervisor, ABlowIsNoFaultAndAFaultAfterABlowIsOne) {
  const std::string blow =
      "[[load]]\nplane = \"A\"\nforce = [-250.0, 100.0]\nstart = 0.02\nstop = 0.022\n";
  for (double Omega : {0.0, 1256.64, 6283.19}) {
    const Outcome o = Simulated(Spin(0.06, Omega, 9) + blow, Drawn(9, 1));
    EXPECT_TRUE(o.result.touchdown);
    EXPECT_EQ(o.When("detected"), kInfinity) << Omega;
  }
  for (const char* target : {"A.coil2", "A.coil6", "B.coil4"}) {
    const Outcome o =
        Simulated(Spin(0.04, 157, 9) + blow + FaultTable(0.0245, target, "open"), Drawn(9, 1));
    EXPECT_EQ(o.Class(target), "open");
    EXPECT_LT(o.result.metrics.detection_delay, 1e-3) << target;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << target;
  }
}

// Clamped: the position loop is off, but the sensors are read and the coils are watched all the
// same.
TEST(FaultSupervisor, NamesAFaultOfAClampedRig) {
  std::string clamped =
      "duration = 0.02\nseed = 7\n[start]\nstate = \"clamped\"\nposition = { A = [4e-5, -3e-5] }\n";
  for (int coil = 1; coil <= 8; ++coil)
    clamped += fmt::format(
        "[[excitation]]\ntarget = \"A.coil{}\"\nport = \"current\"\nkind = \"step\"\n"
        "amplitude = 2.0\n",
        coil);
  for (const char* kind : {"open", "switch-stuck-on"}) {
    const Outcome o = Simulated(clamped + FaultTable(0.01, "A.coil3", kind), Drawn(7, 1));
    EXPECT_EQ(o.Class("A.coil3"), kind);
    EXPECT_LT(o.result.metrics.detection_delay, 0.2e-3) << kind;
    EXPECT_EQ(o.result.metrics.false_alarms, 0) << kind;
    EXPECT_EQ(o.When("redistributed"), kInfinity) << kind;
  }
}

TEST(FaultSupervisor, SlopeTracesShowTheFaultyCoilLeaveItsBand) {
  const Outcome o =
      Simulated(Spin(0.03, 157, 3) + FaultTable(0.02, "A.coil3", "open"), Rig(), true, true);
  ASSERT_EQ(o.result.slopes.size(), 4u);
  const SlopeTrace& s = o.result.slopes.front();
  EXPECT_EQ(s.coil, "A.coil3");
  // Then the neighbours, the next one first, and the coil on the other side.
  EXPECT_EQ(o.result.slopes[1].coil, "A.coil4");
  EXPECT_EQ(o.result.slopes[2].coil, "A.coil2");
  EXPECT_EQ(o.result.slopes[3].coil, "A.coil7");
  std::size_t before = 0, after = 0;
  for (std::size_t k = 0; k < s.t.size(); ++k) {
    const bool outside = s.slope[k] < s.low[k] || s.slope[k] > s.high[k];
    (s.t[k] < 0.0199 ? before : after) += outside && (s.t[k] < 0.0199 || s.t[k] < 0.0202);
  }
  EXPECT_LE(before, 1u);
  EXPECT_GE(after, 3u);
  EXPECT_NEAR(s.t.front(), 0.015, 2e-4);
}

/// Keeps by how much the way to the first new map lets every set-point of bearing A change in one
/// controller period.
class TransitionWitness : public Supervisor {
 public:
  explicit TransitionWitness(const FaultSupervisorOptions& options)
      : inner_(NominalRig(Rig()), options) {}
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput& out) override {
    inner_.AfterPeriod(m, control, out);
    for (const ControlAction& action : out.actions) {
      const auto* change = std::get_if<ReplaceMap>(&action);
      if (!change || !change->current_transition || !steps.isZero()) continue;
      const auto way = change->current_transition->Clone();
      const CoilVector far = CoilVector::Constant(100), first = way->Step(far, {0, 0});
      steps = way->Step(far, {0, 0}) - first;
    }
  }
  CoilVector steps = CoilVector::Zero();  // [A]

 private:
  FaultSupervisor inner_;
};

// 0.8 of the bus of 30 V change the current of a coil of 1.75 mH (docs/theory/base_model.md) by 1.1
// A in 80 us.
TEST(FaultSupervisor, ARampTakesMostOfTheBusForItsChange) {
  FaultSupervisorOptions options;
  options.current_transition = "ramp";
  options.cache_dir = ::testing::TempDir() + "ambrig_fdd_tables";
  TransitionWitness witness(options);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = &witness;
  const Scenario s =
      ReadScenarioText("name = \"t\"\n" + Spin(0.012, 157, 1) + FaultTable(0.01, "A.coil3", "open"),
                       "t.toml", Rig());
  SwitchingEngine(Rig(), s, engine).Run();
  for (int j = 0; j < 8; ++j)
    if (j != 2) {
      EXPECT_NEAR(witness.steps[j], 0.8 * 30 * 80e-6 / 1.75e-3, 0.005) << j;
    }
}

}  // namespace
}  // namespace ambrig
