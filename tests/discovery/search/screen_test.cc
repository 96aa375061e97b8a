// What the screening tries and in which order, on readings that are linear in gain and offset.
#include "discovery/search/screen.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "core/base/coil_name.h"
#include "discovery/search/effect_round.h"
#include "discovery/search/visible_size.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using ::testing::Each;

constexpr double kScreenN = 300;
const std::vector<double> kScreenX = {2e-5, 4e-5, 6e-5, 5e-5};

ScreenOptions Options() {
  ScreenOptions o;
  o.effective_sample_size = kScreenN;
  return o;
}

std::set<std::string> NamesOf(const std::vector<Candidate>& all) {
  std::set<std::string> names;
  for (const Candidate& c : all) names.insert(c.effect.name);
  return names;
}

TEST(Screen, AsksForOneEffectOrOneTargetOnly) {
  const LinearCase c(kScreenX, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  ScreenOptions o = Options();
  o.effect = "sensor-gain";
  const std::vector<Candidate> gains = Screen(c.model, base, {}, o, bank);
  EXPECT_EQ(NamesOf(gains), (std::set<std::string>{"sensor-gain"}));
  ASSERT_FALSE(gains.empty());
  EXPECT_EQ(gains[0].effect.target, "A.x");
  SignatureBank other;
  o.effect.clear();
  o.target = "A.y";  // held at zero, where nothing is read
  for (const Candidate& k : Screen(c.model, base, {}, o, other)) EXPECT_EQ(k.effect.target, "A.y");
}

// A clamped rotor at rest shows nothing of what needs rotation or levitation: it is not tried.
TEST(Screen, LeavesOutWhatTheseRecordsCannotShow) {
  const LinearCase c(kScreenX, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  const std::vector<Candidate> all = Screen(c.model, base, {}, Options(), bank);
  ASSERT_FALSE(all.empty());
  for (const SignatureBank::Entry& e : bank.entries()) {
    const EffectDescription& d = EffectNamed(e.group.probes[0].name);
    EXPECT_FALSE(d.needs.rotation || d.needs.levitation || d.needs.contact || d.needs.free_speed)
        << d.id;
    EXPECT_FALSE(d.users_own) << d.id;
  }
}

TEST(Screen, ACoarseOneTriesNoSingleCoilAndNoFrequency) {
  const LinearCase c(kScreenX, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  ScreenOptions o = Options();
  o.coarse = true;
  const std::vector<Candidate> all = Screen(c.model, base, {}, o, bank);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].effect.name, "sensor-gain");
  for (const SignatureBank::Entry& e : bank.entries()) {
    EXPECT_EQ(e.group.probes[0].target.find(".coil"), std::string::npos);
    for (const EffectParameter& p : e.group.probes[0].table) EXPECT_NE(p.name, "frequency");
  }
}

// What the fit has is not proposed again; what explains nothing more comes at its price.
TEST(Screen, WhatTheFitHasIsNotProposedAgain) {
  const LinearCase c(kScreenX, 1.08, 0);
  FitOptions options;
  options.effective_sample_size = kScreenN;
  const FitResult fit = Fit(c.model, c.With({LinearCase::Gain(1.05)}), options);
  ASSERT_TRUE(fit.converged);
  SignatureBank bank;
  ScreenOptions o = Options();
  o.target = "A.x";
  for (const Candidate& k : Screen(c.model, fit, {}, o, bank))
    EXPECT_NE(k.effect.name, "sensor-gain");
  for (const CandidatePair& p : ScreenPairs(c.model, fit, kScreenN, bank, 5)) {
    EXPECT_NE(p.first.name, "sensor-gain");
    EXPECT_NE(p.second.name, "sensor-gain");
  }
}

TEST(Screen, TellsOfItsProgressAndSimulatesNothingTwice) {
  const LinearCase c(kScreenX, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  std::vector<double> told;
  ScreenOptions o = Options();
  o.target = "A.x";
  o.progress = [&](double f, const std::string&) { told.push_back(f); };
  const std::vector<Candidate> first = Screen(c.model, base, {}, o, bank);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_THAT(told, Each(::testing::AllOf(::testing::Ge(0), ::testing::Le(1))));
  const long runs = c.model.runs;
  const std::vector<Candidate> again = Screen(c.model, base, {}, o, bank);
  EXPECT_EQ(c.model.runs, runs);
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(again[k].effect.name, first[k].effect.name);
    EXPECT_DOUBLE_EQ(again[k].score, first[k].score);
  }
}

// What no effect of a reading explains may be one coil's, also where the coils were not tried at
// first.
TEST(Screen, TriesSingleCoilsLaterWhereAChannelStandsOut) {
  Case data = LinearCase::Make(kScreenX, 1, 0);
  for (CaseRecord& r : data.records)
    for (std::size_t k = 0; k < LinearCase::kRows; k += 2)
      r.data.channels[0].samples[k] += 5 * LinearCase::kFloor;
  CaseModel model(data);
  for (Target& t : model.targets()) t.floor = LinearCase::kFloor;
  FitResult base = Fit(model, Hypothesis::Base(data.rig), {});
  base.jacobian = Eigen::MatrixXd(static_cast<Eigen::Index>(model.size()), 0);
  const auto coils = [](const SignatureBank& bank) {
    return std::count_if(bank.entries().begin(), bank.entries().end(), [](const auto& e) {
      return e.group.probes[0].target.find(".coil") != std::string::npos;
    });
  };
  SignatureBank bank;
  ScreenOptions o = Options();
  o.coarse = true;
  Screen(model, base, {}, o, bank);
  ASSERT_FALSE(bank.entries().empty());
  ASSERT_EQ(coils(bank), 0);
  o.coarse = false;
  FitResult quiet = base;
  for (double& r : quiet.residual) r *= 0.3;
  Screen(model, quiet, {}, o, bank);
  EXPECT_EQ(coils(bank), 0);
  Screen(model, base, {}, o, bank);
  EXPECT_GT(coils(bank), 0);
  // A coarse screen of the same bank leaves them out and simulates nothing.
  o.coarse = true;
  const long runs = model.runs;
  const std::vector<Candidate> few = Screen(model, base, {}, o, bank);
  EXPECT_EQ(model.runs, runs);
  ASSERT_FALSE(few.empty());
  for (const Candidate& k : few) {
    EXPECT_FALSE(NamesCoil(k.effect.target)) << k.effect.target;
    for (const EffectParameter& p : k.effect.table) EXPECT_NE(p.name, "frequency");
  }
}

// The readings of B are not in the case: an effect there is half of no pair, whatever the other
// half does.
TEST(ScreenPairs, HoldNoEffectThatChangesNothing) {
  const LinearCase c(kScreenX, 1.08, 2e-6);
  const FitResult base = c.Base();
  EffectInstance unseen = MakeInstance(EffectNamed("sensor-offset"), "B.x");
  unseen.Set("offset", 1e-5);
  const auto group = [](const EffectInstance& e) {
    ProbeGroup g;
    g.probes = {e};
    g.rows = {0};
    return g;
  };
  SignatureBank bank;
  bank.Simulate(c.model, base,
                {group(LinearCase::Gain(1.05)), group(unseen), group(LinearCase::Offset(1e-6))},
                {});
  const std::vector<CandidatePair> pairs = ScreenPairs(c.model, base, kScreenN, bank, 5);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(Named(pairs[0].first), "sensor-gain at A.x");
  EXPECT_EQ(Named(pairs[0].second), "sensor-offset at A.x");
}

TEST(ScreenPairs, ComeInTheOrderOfTheirScoreAndOnceEach) {
  const LinearCase c({2e-5, 4e-5, 6e-5, -5e-5}, 1.3, -2e-5);
  const FitResult base = c.Base();
  SignatureBank bank;
  ScreenOptions o = Options();
  Screen(c.model, base, {}, o, bank);
  const std::vector<CandidatePair> pairs = ScreenPairs(c.model, base, kScreenN, bank, 4);
  ASSERT_GE(pairs.size(), 2u);
  EXPECT_LE(pairs.size(), 4u);
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::string first = Named(pairs[k].first), second = Named(pairs[k].second);
    EXPECT_TRUE(seen.emplace(first, second).second);
    EXPECT_NE(first, second);
    if (k > 0) {
      EXPECT_LE(pairs[k - 1].score, pairs[k].score);
    }
  }
  const std::set<std::string> best{Named(pairs[0].first), Named(pairs[0].second)};
  EXPECT_EQ(best, (std::set<std::string>{"sensor-gain at A.x", "sensor-offset at A.x"}));
}

// An effect that the records show twice as strongly is visible at half the size.
TEST(VisibleSizes, ScaleWithWhatIsSeen) {
  const auto gain = [](double far) {
    const LinearCase c({0.4 * far, far, -far, 0.5 * far}, 1, 0);
    const FitResult base = c.Base();
    SignatureBank bank;
    bank.Simulate(c.model, base, ProbesOf(EffectNamed("sensor-gain"), "A.x", c.model, {}), nullptr);
    return VisibleSizes(c.model, base, kScreenN, bank).at(0).size;
  };
  EXPECT_NEAR(gain(3e-5) / gain(6e-5), 2, 1e-3);
}

}  // namespace
}  // namespace ambrig
