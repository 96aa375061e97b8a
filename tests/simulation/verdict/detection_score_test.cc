#include "simulation/verdict/detection_score.h"

#include <gtest/gtest.h>

#include "simulation/verdict/expect.h"

namespace ambrig {
namespace {

FaultSpec Fault(double time, const std::string& target, const std::string& kind = "open") {
  FaultSpec f;
  f.time = time;
  f.target = target;
  f.kind = kind;
  return f;
}

RunEvent Alarm(double t, const std::string& target) { return {t, "detected", target, "", 0}; }
RunEvent Class(double t, const std::string& target, const std::string& kind) {
  return {t, "classified", target, kind, 0};
}

TEST(DetectionScore, FirstAlarmOfEachTargetAfterItsFault) {
  const DetectionScore score =
      ScoreDetection({Fault(1, "A.coil1"), Fault(2, "B.coil2"), Fault(3, "A.coil5")},
                     {Alarm(1.25, "A.coil1"),
                      Alarm(1.5, "A.coil1"),
                      {1.75, "redistributed", "A", "", 0},
                      Alarm(2.5, "B.coil2")});
  ASSERT_EQ(score.faults.size(), 3u);
  EXPECT_EQ(score.faults[0].detected, 0.25);
  EXPECT_EQ(score.faults[1].detected, 0.5);
  EXPECT_EQ(score.faults[2].detected, std::nullopt);
  EXPECT_EQ(score.faults[0].redistributed, 0.75);
  EXPECT_EQ(score.faults[1].redistributed, std::nullopt);
  EXPECT_EQ(score.detected(), 2u);
  EXPECT_FALSE(score.all_detected());
  EXPECT_EQ(score.longest_detection(), 0.5);
  EXPECT_EQ(score.longest_redistribution(), 0.75);
  EXPECT_EQ(score.false_alarms, 0u);
}

TEST(DetectionScore, AlarmsOfHealthyTargetsAndBeforeTheFaultAreFalse) {
  const DetectionScore score =
      ScoreDetection({Fault(1, "A.coil1")}, {Alarm(0.5, "A.coil1"),
                                             Alarm(1, "A.coil1"),
                                             Alarm(1.5, "A.coil2"),
                                             {1.75, "alarm_cleared", "A.coil2", "", 0}});
  EXPECT_EQ(score.false_alarms, 2u);
  EXPECT_EQ(score.faults[0].detected, 0.0);
}

// A rotor that dropped, or went past the poles, is no working machine any more: what fails then
// need not be found, and what is said then blames nobody.
TEST(DetectionScore, WhatComesAfterTheRotorWasLostIsNotJudged) {
  for (const char* lost : {"drop", "model_invalid"}) {
    const DetectionScore score =
        ScoreDetection({Fault(1, "A.coil1"), Fault(3, "A.coil2")}, {Alarm(0.5, "A.coil7"),
                                                                    {2, lost, "A", "", 0},
                                                                    Alarm(2.5, "A.coil1"),
                                                                    Alarm(2.5, "A.coil8"),
                                                                    Alarm(3.5, "A.coil2")});
    EXPECT_EQ(score.judged(), 1u) << lost;
    EXPECT_EQ(score.detected(), 1u) << lost;  // late, but the fault was there before
    EXPECT_EQ(score.false_alarms, 1u) << lost;
    EXPECT_TRUE(score.all_detected()) << lost;  // all that are judged
  }
}

// The second fault comes to a rotor that is lost: the first one alone decides, and the text says
// so.
TEST(DetectionScore, ExpectationsSkipFaultsThatAreNotJudged) {
  Scenario s;
  s.faults = {Fault(1, "A.coil3"), Fault(3, "B.coil3")};
  s.expect.detected_within = 0.5;
  s.expect.classified = "open";
  RunResult r;
  r.events = {Alarm(1.25, "A.coil3"),
              Class(1.25, "A.coil3", "open"),
              {2, "drop", "A", "", 0},
              Alarm(3.25, "B.coil3"),
              Class(3.25, "B.coil3", "partial-short")};
  auto results = CheckExpectations(s, r);
  EXPECT_TRUE(AllMet(results));
  EXPECT_EQ(results[0].got, "250 ms (1 fault not judged: the rotor was lost)");
  EXPECT_EQ(results[1].got, "open (1 fault not judged: the rotor was lost)");
  // A fault that is judged still decides.
  s.faults[0].target = "A.coil4";
  EXPECT_FALSE(CheckExpectations(s, r)[0].met);
  EXPECT_FALSE(CheckExpectations(s, r)[1].met);
  // Nothing that is judged shows nothing.
  s.faults = {Fault(3, "B.coil3")};
  results = CheckExpectations(s, r);
  for (const ExpectResult& e : results) {
    EXPECT_FALSE(e.met) << e.key;
    EXPECT_EQ(e.got, "not judged: the rotor was lost") << e.key;
  }
}

// Told is what did not happen.
TEST(DetectionScore, WhatIsNotRedistributedHasNoDelay) {
  const DetectionScore score = ScoreDetection(
      {Fault(1, "A.coil1")}, {Alarm(1.25, "A.coil1"), {1.25, "not_redistributed", "A", "none", 0}});
  EXPECT_EQ(score.faults[0].redistributed, std::nullopt);
  EXPECT_EQ(score.longest_redistribution(), -1);
}

// What another bearing does about its own fault is nothing to this one.
TEST(DetectionScore, EachFaultIsRedistributedAtItsOwnBearing) {
  Scenario s;
  s.faults = {Fault(1, "A.coil2"), Fault(2, "B.coil2")};
  s.expect.redistributed = true;
  RunResult r;
  r.events = {Alarm(1.25, "A.coil2"),
              {1.25, "redistributed", "A", "exact", 0},
              Alarm(2.25, "B.coil2"),
              {2.25, "not_redistributed", "B", "none", 0},
              {2.5, "redistributed", "A", "exact", 0}};
  const std::vector<ExpectResult> results = CheckExpectations(s, r);
  EXPECT_FALSE(AllMet(results));
  EXPECT_EQ(results[0].got, "of 1 of 2 faults");
  ScoreDetection(s, r);
  EXPECT_EQ(r.metrics.redistribution_delay, -1);
  r.events.push_back({2.75, "redistributed", "B", "exact", 0});
  EXPECT_TRUE(AllMet(CheckExpectations(s, r)));
  ScoreDetection(s, r);
  EXPECT_EQ(r.metrics.redistribution_delay, 0.75);
}

TEST(DetectionScore, TheLastClassCounts) {
  const std::vector<FaultSpec> faults = {Fault(1, "A.coil1", "partial-short"),
                                         Fault(1, "A.coil2", "open"), Fault(1, "A.coil3", "open")};
  const DetectionScore score =
      ScoreDetection(faults, {Class(0.5, "A.coil3", "open"), Class(1.25, "A.coil1", "open"),
                              Class(1.5, "A.coil1", "partial-short"), Class(1.5, "A.coil2", "open"),
                              Class(2, "A.coil2", "partial-short")});
  EXPECT_TRUE(score.faults[0].right_class);
  EXPECT_FALSE(score.faults[1].right_class);
  EXPECT_EQ(score.faults[1].last_class, "partial-short");
  EXPECT_EQ(score.faults[2].last_class, "");
  EXPECT_EQ(score.right_class(), 1u);
}

TEST(DetectionScore, OfAHealthyRun) {
  const DetectionScore score = ScoreDetection({}, {Alarm(1, "A.coil1")});
  EXPECT_EQ(score.longest_detection(), -1);
  EXPECT_EQ(score.longest_redistribution(), -1);
  EXPECT_EQ(score.false_alarms, 1u);
  EXPECT_TRUE(score.all_detected());
}

// [expect] asks for every fault, and a run in which one is missed has no delay.
TEST(DetectionScore, ExpectationsWantEveryFault) {
  Scenario s;
  s.faults = {Fault(1, "A.coil1"), Fault(1, "A.coil2")};
  s.expect.detected_within = 0.5;
  s.expect.classified = "open";
  RunResult r;
  r.events = {Alarm(1.25, "A.coil1"), Class(1.25, "A.coil1", "open")};
  EXPECT_FALSE(AllMet(CheckExpectations(s, r)));
  ScoreDetection(s, r);
  EXPECT_EQ(r.metrics.detection_delay, -1);
  r.events.push_back(Alarm(1.5, "A.coil2"));
  r.events.push_back(Class(1.5, "A.coil2", "open"));
  EXPECT_TRUE(AllMet(CheckExpectations(s, r)));
  *s.expect.detected_within = 0.25;
  const auto results = CheckExpectations(s, r);
  EXPECT_FALSE(results[0].met);
  EXPECT_EQ(results[0].got, "500 ms");
  EXPECT_TRUE(results[1].met);
}

}  // namespace
}  // namespace ambrig
