// What a probe current tells of a coil, from sums as slope_excess.h gives them and on plants with
// effects; and what becomes of coils that lie idle.
#include "fdd/commissioned/coil_probe.h"

#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

constexpr int kProbed = 3, kPeriods = 40;

/// Sums of one period in which c is `on` and `off` in the two phases of the probed coil.
SlopeExcess Sums(double on, double off, double weight = 100) {
  SlopeExcess e;
  e.bottom[0][kProbed] = e.bottom[1][kProbed] = weight;
  e.top[0][kProbed] = on * weight;
  e.top[1][kProbed] = off * weight;
  return e;
}

ProbeAnswer AnswerTo(CoilProbe& probe, const SlopeExcess& each, int periods = kPeriods,
                     double current = 0.8) {
  for (int n = 0; n < periods; ++n) probe.Add(each, current);
  return probe.answer();
}

TEST(CoilProbe, RightSlopesInBothPhasesAreHealthy) {
  CoilProbe probe;
  probe.Begin(kProbed, 0.01, 0.2);
  EXPECT_TRUE(probe.running());
  EXPECT_EQ(AnswerTo(probe, Sums(0.1, -0.05), 20), ProbeAnswer::kNone);  // not before it is over
  EXPECT_EQ(AnswerTo(probe, Sums(0.1, -0.05)), ProbeAnswer::kHealthy);
  EXPECT_NEAR(probe.excess(), 0.025, 1e-12);
  EXPECT_FALSE(probe.no_current());
}

TEST(CoilProbe, OnePhaseThatIsWrongOrWasNotSeenIsNotHealthy) {
  for (const SlopeExcess& e : {Sums(0.5, -0.5), Sums(0.3, 0.3), Sums(0.1, 0.1, 0.1)}) {
    CoilProbe probe;
    probe.Begin(kProbed, 0, 0.2);
    EXPECT_EQ(AnswerTo(probe, e), ProbeAnswer::kFaulty);
    EXPECT_FALSE(probe.no_current());
  }
}

TEST(CoilProbe, NoSlopeAtAllIsToldAtOnce) {
  CoilProbe probe;
  probe.Begin(kProbed, 0, 0.2);
  EXPECT_EQ(AnswerTo(probe, Sums(-0.95, 0), 5), ProbeAnswer::kNone);  // the first periods count not
  SlopeExcess e = Sums(-0.95, 0);
  e.bottom[1][kProbed] = 0;
  EXPECT_EQ(AnswerTo(probe, e, 4), ProbeAnswer::kFaulty);
  EXPECT_TRUE(probe.no_current());
}

// With a deviation of 0.45 three periods in a row are below -0.7 now and then.
TEST(CoilProbe, NoSlopeWithinTheNoiseIsNotToldAtOnce) {
  CoilProbe probe;
  probe.Begin(kProbed, 0, 0.2);
  for (const SlopeExcess& e : {Sums(-0.8, -0.8, 2.5), Sums(0.2, 0.2, 2.5)}) AnswerTo(probe, e, 6);
  EXPECT_FALSE(probe.no_current());
  EXPECT_EQ(probe.answer(), ProbeAnswer::kNone);
}

TEST(CoilProbe, EndsWhenAnotherCoilFails) {
  CoilProbe probe;
  probe.Begin(kProbed, 0, 0.2);
  SlopeExcess e = Sums(0, 0);
  e.bottom[0][5] = e.bottom[1][5] = 100;
  e.top[0][5] = e.top[1][5] = 40;  // c = 0.4
  for (int n = 0; n < 3; ++n) probe.WatchOthers(e);
  EXPECT_EQ(AnswerTo(probe, e, 5), ProbeAnswer::kNone);
  e.top[0][5] = e.top[1][5] = 100;
  for (int n = 0; n < 2; ++n) probe.WatchOthers(e);
  EXPECT_EQ(probe.answer(), ProbeAnswer::kNone);
  probe.WatchOthers(e);
  EXPECT_EQ(probe.answer(), ProbeAnswer::kInterrupted);
  // What was gross from the start is an error of the circuit: it says nothing new.
  probe.Begin(kProbed, 0, 0.2);
  for (int n = 0; n < 5; ++n) probe.WatchOthers(e);
  EXPECT_EQ(probe.answer(), ProbeAnswer::kNone);
}

// Neighbours that switch with it give an open coil right slopes.
TEST(CoilProbe, RightSlopesWithoutCurrentAreAnOpenCoil) {
  CoilProbe probe;
  probe.Begin(kProbed, 0, 0.2);
  EXPECT_EQ(AnswerTo(probe, Sums(0.05, 0.05), kPeriods, 0.02), ProbeAnswer::kFaulty);
  EXPECT_TRUE(probe.no_current());
}

TEST(CoilProbe, AReadingThatWasNotZeroBeforeIsFalse) {
  CoilProbe probe;
  probe.Begin(kProbed, 0.3, 0.2);
  EXPECT_EQ(probe.answer(), ProbeAnswer::kFaulty);
  EXPECT_EQ(AnswerTo(probe, Sums(0, 0)), ProbeAnswer::kFaulty);  // and stays so
}

/// A coil of bearing A by its detector alone, under currents that it is driven with.
class ProbedPlant : public Supervisor {
 public:
  ProbedPlant(const testing_plant::CommissionedRig& plant, int coil)
      : rig_(plant.rig), feed_(rig_), coil_(coil) {
    const BearingParameters& b = rig_->bearings[0];
    const LinkageModel m = LinkageModelOf(b);
    run_ = std::make_unique<CommissionedRun>(CoilDetectorSetup{m, DetectorSettingsOf(rig_, b, m)},
                                             plant.bearing);
  }
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput&) override {
    feed_.Read(m);
    MeasuredPeriod in = feed_.Period(0, m);
    in.set_point = &control[0].commanded;
    judged += run_->Period(in).coil >= 0 && probing_;
    if (!probing_ && !done && m.t > 0.031) {
      probing_ = run_->BeginProbe(coil_);
    } else if (probing_ && run_->Probed() != ProbeAnswer::kNone) {
      answer = run_->Probed();
      found = run_->EndProbe(false, m.t);
      probing_ = false;
      done = true;
    }
  }
  int judged = 0;  // decisions while the probe ran
  bool done = false;
  ProbeAnswer answer = ProbeAnswer::kNone;
  Diagnosis found;

 private:
  const NominalRig rig_;
  DetectionFeed feed_;
  int coil_;
  bool probing_ = false;
  std::unique_ptr<CommissionedRun> run_;
};

ProbedPlant Probed(const std::string& fault, int coil) {
  const testing_plant::CommissionedRig& plant = testing_plant::SlowIron();
  ProbedPlant watched(plant, coil);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = &watched;
  SwitchingEngine(plant.rig,
                  ReadScenarioText(testing_plant::Operation(fault), "operation.toml", plant.rig),
                  engine)
      .Run();
  return watched;
}

TEST(CoilProbe, OfAWorkingCoilTheFaultThatItShows) {
  const ProbedPlant healthy = Probed("", 2);
  EXPECT_EQ(healthy.answer, ProbeAnswer::kHealthy);
  EXPECT_EQ(healthy.found.cls, FaultClass::kNone);
  // It breaks or loses turns while the probe runs: no other coil is judged then.
  const ProbedPlant open = Probed(testing_plant::FaultOf(3, "open", "", 0.03105), 2);
  EXPECT_EQ(open.judged, 0);
  EXPECT_EQ(open.found.cls, FaultClass::kOpen);
  EXPECT_EQ(open.found.coil, 2);
  const ProbedPlant shorted =
      Probed(testing_plant::FaultOf(3, "partial-short", "fraction = 0.5", 0.03105), 2);
  EXPECT_EQ(shorted.judged, 0);
  EXPECT_EQ(shorted.found.cls, FaultClass::kPartialShort);
  EXPECT_NEAR(shorted.found.fraction, 0.5, 0.05);
}

}  // namespace
}  // namespace ambrig
