#include "discovery/plan/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

TEST(PlanCandidates, AreScenariosThatTheRigReads) {
  const RigParameters rig = ReferenceRig();
  const std::vector<PlanCandidate> all = PlanCandidates(rig, StatedAbilities(rig, 1000, true), 3);
  EXPECT_GE(all.size(), 18u);
  for (const PlanCandidate& c : all)
    for (const double size : {1.0, 0.2}) {
      const Scenario s = ReadScenarioText(c.toml(size), c.title, rig);
      EXPECT_EQ(s.start == StartState::kClamped, c.clamped) << c.title;
      EXPECT_EQ(s.duration, c.duration) << c.title;
      EXPECT_EQ(s.record_rate > 2 * rig.controller.rate, c.burst) << c.title;
    }
}

// A rig that does not turn is never asked to, nor one that cannot be held.
TEST(PlanCandidates, AskOnlyForWhatTheRigCanDo) {
  const RigParameters rig = ReferenceRig();
  for (const double top : {0.0, 700.0}) {
    double fastest = 0;
    for (const PlanCandidate& c : PlanCandidates(rig, StatedAbilities(rig, top, false), 3)) {
      EXPECT_FALSE(c.clamped) << c.title;
      const Scenario s = ReadScenarioText(c.toml(1), c.title, rig);
      for (const double part : {0.0, 0.5, 1.0})
        fastest = std::max(fastest, std::abs(s.speed.Speed(part * s.duration)));
    }
    EXPECT_NEAR(fastest, top, 1e-6 * top);
  }
}

TEST(PlanCandidates, SizeScalesTheExcitation) {
  const RigParameters rig = ReferenceRig();
  for (const PlanCandidate& c : PlanCandidates(rig, StatedAbilities(rig, 0, false), 3)) {
    const Scenario one = ReadScenarioText(c.toml(1), c.title, rig),
                   half = ReadScenarioText(c.toml(0.5), c.title, rig);
    for (std::size_t k = 0; k < one.excitations.size(); ++k)
      EXPECT_NEAR(half.excitations[k].amplitude, 0.5 * one.excitations[k].amplitude,
                  1e-5 * std::abs(one.excitations[k].amplitude))
          << c.title;
  }
}

CaseRecord RecordWith(const RigParameters& rig, const std::string& start, const std::string& more) {
  CaseRecord r;
  r.scenario = ReadScenarioText(
      "name = \"r\"\nrig = \"rig.toml\"\nduration = 0.1\nrecord_rate = 12500.0\n[start]\nstate = "
      "\"" +
          start + "\"\n" + more,
      "r.toml", rig);
  r.data.rate = 12500;
  r.data.channels = {{"A.i1", "A", std::vector<double>(4, 0)}};
  return r;
}

TEST(Abilities, AreWhatTheRecordsShow) {
  Case c;
  c.rig = ReferenceRig();
  c.records.push_back(
      RecordWith(c.rig, "levitated", "[speed]\nprofile = [[0.0, 0.0], [0.1, 300.0]]\n"));
  Abilities a = AbilitiesOf(c);
  EXPECT_TRUE(a.levitate);
  EXPECT_FALSE(a.clamp || a.burst || a.land || a.load || a.reference);
  EXPECT_EQ(a.top_speed, 300);
  EXPECT_EQ(a.channels, (std::set<std::string>{"A.i1"}));
  c.records = {RecordWith(c.rig, "clamped",
                          "[speed]\nprofile = [[0.0, 0.0], [0.1, 0.0]]\n[[excitation]]\ntarget = "
                          "\"A.coil1\"\nport = \"duty\"\nkind = \"step\"\nstart = 0.0\nstop = "
                          "0.1\namplitude = 0.4\n")};
  a = AbilitiesOf(c);
  EXPECT_TRUE(a.clamp);
  EXPECT_FALSE(a.levitate);
  EXPECT_EQ(a.top_speed, 0);
  EXPECT_EQ(a.coil_port, "duty");
  EXPECT_EQ(a.coil_most, 0.4);
}

}  // namespace
}  // namespace ambrig
