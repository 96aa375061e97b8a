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

// A rig that is controlled at 1 kHz and logged at 200 Hz: no line beyond what either tells.
TEST(PlanCandidates, StayWithinTheBandOfControllerAndLogger) {
  RigParameters rig = ReferenceRig();
  rig.controller.rate = 1000;
  Abilities able = StatedAbilities(rig, 0, false);
  able.record_rate = 200;
  double highest = 0;
  for (const PlanCandidate& c : PlanCandidates(rig, able, 3))
    for (const Excitation& e : ReadScenarioText(c.toml(1), c.title, rig).excitations)
      for (const double f : e.frequencies) highest = std::max(highest, f);
  EXPECT_GT(highest, 40);
  EXPECT_LE(highest, 80 + 0.5);
}

// Records of a free rotor last as long as its loop needs to answer.
TEST(PlanCandidates, LastAsLongAsTheSlowestModeNeeds) {
  RigParameters rig = ReferenceRig();
  const auto longest = [&] {
    double out = 0;
    for (const PlanCandidate& c : PlanCandidates(rig, StatedAbilities(rig, 0, false), 3))
      if (c.title == "low multisine at rest") out = c.duration;
    return out;
  };
  const double usual = longest();
  rig.controller.pid.ki *= 1e-2;
  EXPECT_GT(longest(), 2 * usual);
}

const PlanCandidate& CandidateOf(const std::vector<PlanCandidate>& all, const std::string& title) {
  for (const PlanCandidate& c : all)
    if (c.title == title) return c;
  throw std::runtime_error("no candidate " + title);
}

// A strong multisine is the plain one twice as large; at speed there is the plain broad one alone.
TEST(PlanCandidates, StrongMultisinesAreTwiceThePlainOnes) {
  const RigParameters rig = ReferenceRig();
  const auto all = PlanCandidates(rig, StatedAbilities(rig, 1000, true), 3);
  for (const char* band : {"low", "broad", "high"}) {
    const std::string title = std::string(band) + " multisine at rest";
    const Scenario plain = ReadScenarioText(CandidateOf(all, title).toml(1), title, rig),
                   strong =
                       ReadScenarioText(CandidateOf(all, "strong " + title).toml(1), title, rig);
    ASSERT_EQ(plain.excitations.size(), strong.excitations.size());
    for (std::size_t k = 0; k < plain.excitations.size(); ++k) {
      const Excitation &a = plain.excitations[k], &b = strong.excitations[k];
      EXPECT_NEAR(b.amplitude, 2 * a.amplitude, 1e-5 * a.amplitude);
      EXPECT_EQ(a.frequencies, b.frequencies);
      for (std::size_t n = 1; n < a.frequencies.size(); ++n)
        EXPECT_GE(a.frequencies[n], a.frequencies[n - 1] + 0.5);
    }
    const double most = band == std::string("low")     ? 60
                        : band == std::string("broad") ? 1500
                                                       : 2500;
    EXPECT_LT(plain.excitations[0].frequencies.back(), most);
    EXPECT_GT(plain.excitations[0].frequencies.back(), 0.5 * most);
  }
  int at_speed = 0;
  for (const PlanCandidate& c : all)
    at_speed += c.title.find("multisine") != std::string::npos &&
                        c.title.find("at rest") == std::string::npos
                    ? 1
                    : 0;
  EXPECT_EQ(at_speed, 2);
}

// Held currents reach the most that the rig's coils may carry, small ones half of the way there.
TEST(PlanCandidates, HeldCurrentsEndAtTheMostThatIsAllowed) {
  const RigParameters rig = ReferenceRig();
  const Abilities able = StatedAbilities(rig, 0, true);
  const auto all = PlanCandidates(rig, able, 3);
  for (const auto& [title, part] :
       {std::pair{"held, ramps", 1.0}, {"held, small ramps", 0.5}, {"held, steps", 1.0}}) {
    const Scenario s = ReadScenarioText(CandidateOf(all, title).toml(1), title, rig);
    double least = 1e9, more = 0;
    for (const Excitation& e : s.excitations)
      if (e.start == 0)
        least = std::min(least, e.amplitude);
      else
        more = std::max(more, e.amplitude);
    EXPECT_NEAR(least, able.coil_least, 1e-5) << title;
    EXPECT_NEAR(least + more, able.coil_least + part * (able.coil_most - able.coil_least), 1e-4)
        << title;
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
