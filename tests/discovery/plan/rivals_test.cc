// Distances between models whose outputs are linear in what is unknown: closed forms.
#include "discovery/plan/rivals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/experiment/examination.h"
#include "discovery/plan/safety.h"
#include "tests/discovery/linear_case.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

using Eigen::Index;

constexpr double kAt = 4e-5;  // [m]

/// One record of A.x held at kAt, 50 independent rows of floor 1 um.
TrialRecord HeldTrial() {
  TrialRecord trial;
  trial.data = std::make_unique<Case>(LinearCase::Make({kAt}, 1, 0));
  trial.model = std::make_unique<CaseModel>(*trial.data);
  for (Target& t : trial.model->targets()) t.floor = LinearCase::kFloor;
  return trial;
}

Rival Nothing(const TrialRecord& trial) {
  const Hypothesis h = Hypothesis::Base(trial.data->rig);
  return {"nothing", "", h, Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0)};
}

Rival RivalWith(const TrialRecord& trial, const EffectInstance& e, double precision) {
  Hypothesis h = Hypothesis::Base(trial.data->rig);
  h.AddEffect(e);
  const auto n = static_cast<Index>(h.free.size());
  const Eigen::MatrixXd P = precision * Eigen::MatrixXd::Identity(n, n);
  return {e.name, e.target, h, P, P};
}

struct Views {
  TrialRecord trial = HeldTrial();
  std::vector<double> nothing = *trial.model->Predict(Nothing(trial).hypothesis);
  RivalView Of(const Rival& r) { return ViewOf(trial, r, nothing).value(); }
};

// An offset b read in n rows, its number and its law known well: b/floor sqrt(n) standard
// deviations; a share v of the law in eight blocks and in the one channel that shows it lowers it
// to
//   d² = S' /(1 + v² S'),  S' = Σ s/(1 + v² s) over the blocks,  s: of n b²/floor².
TEST(Rivals, DistanceFromNothingIsThatOfTheSignature) {
  Views v;
  const double b = 5e-7, S = LinearCase::kRows * b * b / LinearCase::kFloor / LinearCase::kFloor;
  const RivalView offset = v.Of(RivalWith(v.trial, LinearCase::Offset(b), 1e12)),
                  nothing = v.Of(Nothing(v.trial));
  // 50 rows in eighths: 6 or 7 rows a block
  const std::vector<double> found = SquaredDistances(v.trial, offset, nothing);
  double probability = 0;
  for (std::size_t n = 0; n < std::size(kLawVariations); ++n) {
    const auto [size, share] = kLawVariations[n];
    double wanted = 0;
    for (int block = 0; block < kLawBlocks; ++block) {
      int rows = 0;
      for (int k = 0; k < 50; ++k) rows += k * kLawBlocks / 50 == block ? 1 : 0;
      const double s = S * rows / 50;
      wanted += s / (1 + size * size * s);
    }
    wanted /= 1 + size * size * wanted;
    EXPECT_NEAR(found.at(n), wanted, 1e-6 * wanted);
    probability += share * ProbabilityRight(wanted);
  }
  EXPECT_NEAR(ProbabilityRight(found), probability, 1e-9);
  EXPECT_NEAR(ProbabilityRight(std::pow(DistanceOf(probability), 2)), probability, 1e-9);
}

// A record's own zero of sd z may be what an offset b is: to explain it costs at least (b/z)²,
// shared by both models.
TEST(Rivals, ZerosOfTheRecordAreNoDistance) {
  for (const double zero : {1e-4, 2e-7}) {
    Views v;
    const double b = 5e-7;
    const Target& reading = v.trial.model->targets()[0];
    v.trial.nuisances = Eigen::MatrixXd::Zero(static_cast<Index>(v.trial.model->size()), 1);
    v.trial.nuisances.col(0)
        .segment(static_cast<Index>(reading.first), static_cast<Index>(reading.count))
        .setConstant(zero / LinearCase::kFloor);
    const double with = SquaredDistances(v.trial,
                                         v.Of(RivalWith(v.trial, LinearCase::Offset(b), 1e12)),
                                         v.Of(Nothing(v.trial)))[0],
                 cost = b * b / (2 * zero * zero);
    EXPECT_LT(with, 1.001 * cost);
    EXPECT_GT(with, 0.5 * std::min(cost, 10.0));
  }
}

// At one position a gain and an offset read the same: whatever the record's length, no distance.
TEST(Rivals, WhatLooksAlikeHasNoDistance) {
  Views v;
  const RivalView offset = v.Of(RivalWith(v.trial, LinearCase::Offset(0.05 * kAt), 1e-4)),
                  gain = v.Of(RivalWith(v.trial, LinearCase::Gain(1.06), 1e-4));
  EXPECT_LT(SquaredDistances(v.trial, offset, gain)[0], 0.1);
  EXPECT_NEAR(ProbabilityRight(0), 0.5, 1e-12);
  EXPECT_NEAR(ProbabilityRight(21.7), 0.99, 1e-3);
}

// A record with the offset speaks for the offset, one without for nothing.
TEST(Rivals, DisbeliefPrefersTheTruth) {
  Views v;
  const RivalView offset = v.Of(RivalWith(v.trial, LinearCase::Offset(2e-6), 1)),
                  nothing = v.Of(Nothing(v.trial));
  EXPECT_LT(Disbelief(v.trial, offset, offset.predicted),
            Disbelief(v.trial, nothing, offset.predicted));
  EXPECT_LT(Disbelief(v.trial, nothing, nothing.predicted),
            Disbelief(v.trial, offset, nothing.predicted));
}

TrialRecord LevitatedTrial(double step) {
  RigParameters rig = ReferenceRig();
  TrialRecord trial;
  trial.data = std::make_unique<Case>(EmptyCase(
      rig, {{"step",
             fmt::format("name = \"step\"\nrig = \"rig.toml\"\nduration = 0.05\nrecord_rate = "
                         "12500.0\nfault_tolerance = false\n[start]\nstate = \"levitated\"\n"
                         "[speed]\nprofile = [[0.0, 0.0], [0.05, 0.0]]\n[[excitation]]\ntarget = "
                         "\"A.x\"\nport = \"reference\"\nkind = \"step\"\nstart = 0.01\nstop = "
                         "0.05\namplitude = {}\n",
                         step),
             false, false}}));
  trial.model = std::make_unique<CaseModel>(*trial.data);
  return trial;
}

TEST(Safety, RefusesAnOrbitNearTheStops) {
  const TrialRecord gentle = LevitatedTrial(2e-5), wild = LevitatedTrial(1.9e-4);
  const SafetyResult a = CheckSafety(gentle, Nothing(gentle), {});
  EXPECT_TRUE(a.safe) << a.reason;
  // the step is reached, and even an undamped loop would overshoot to no more than twice of it
  EXPECT_GT(a.largest_orbit, 1.9e-5);
  EXPECT_LT(a.largest_orbit, 4e-5);
  EXPECT_EQ(a.orbit_at, "A");
  EXPECT_NEAR(a.orbit_share, a.largest_orbit / (0.6 * 2e-4), 1e-9);
  const SafetyResult b = CheckSafety(wild, Nothing(wild), {});
  EXPECT_FALSE(b.safe);
  EXPECT_FALSE(b.reason.empty());
}

}  // namespace
}  // namespace ambrig
