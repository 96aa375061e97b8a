// Names that are open alone and decided beside a second effect, in cases that are linear in both.
#include "discovery/decision/rejudge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "discovery/search/candidate_fit.h"
#include "discovery/search/likelihood.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kRejudgeN = 300;

/// A gain of A.x hides in the records beside an offset of A.y that is far larger.
struct GainBesideOffset {
  GainBesideOffset() : data(Make()), model(data) {
    for (Target& t : model.targets()) t.floor = LinearCase::kFloor;
    base = Fit(model, Hypothesis::Base(data.rig), {});
    base.jacobian = Eigen::MatrixXd(static_cast<Eigen::Index>(model.size()), 0);
  }
  static Case Make() {
    Case c = LinearCase::Make({2e-5, 4e-5, 6e-5, 5e-5}, 1.3, 0);
    for (CaseRecord& r : c.records)
      for (double& v : r.data.channels[1].samples) v = 5e-5;
    return c;
  }
  static EffectInstance OffsetOfY(double offset) {
    EffectInstance e = MakeInstance(EffectNamed("sensor-offset"), "A.y");
    e.Set("offset", offset);
    return e;
  }
  FitResult With(const std::vector<EffectInstance>& effects) const {
    Hypothesis h = base.hypothesis;
    for (const EffectInstance& e : effects) h.AddEffect(e);
    return FitOn(model, base, h, kRejudgeN);
  }
  RankedEffect Alone(const EffectInstance& e) const {
    RankedEffect r;
    r.fit = With({e});
    r.effect = FittedEffect(r.fit, 0);
    r.score = Score(model, r.fit, kRejudgeN);
    return r;
  }

  const Case data;
  CaseModel model;
  FitResult base;
};

TEST(RankBeside, ANameThatIsOpenAloneIsDecidedBesideTheSecondEffect) {
  const GainBesideOffset c;
  std::vector<RankedEffect> alone = {c.Alone(LinearCase::Gain(1.2)),
                                     c.Alone(LinearCase::Offset(1e-5))};
  SetProbabilities(c.base, alone);
  ASSERT_EQ(alone[0].effect.name, "sensor-gain");
  EXPECT_GT(alone[1].probability, 0.3);  // what neither explains hides which is right

  const FitResult both = c.With({alone[0].effect, GainBesideOffset::OffsetOfY(4e-5)});
  ASSERT_TRUE(both.converged);
  const std::vector<EffectInstance> found = {FittedEffect(both, 0), FittedEffect(both, 1)};
  const std::vector<RankedEffect> beside =
      RankBeside(c.model, {c.base, both, found}, 0, {alone[1].effect}, kRejudgeN);
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_EQ(Named(beside[0].effect), "sensor-gain at A.x");
  EXPECT_GT(beside[0].probability, 0.99);
  EXPECT_NEAR(beside[0].probability + beside[1].probability, 1, 1e-12);
  EXPECT_EQ(Named(beside[1].effect), "sensor-offset at A.x");
  // Beside the offset of A.y, which stays: least squares of 0.3 x by a constant, to a short fit's 1
  // %.
  EXPECT_NEAR(beside[1].effect.Value("offset"), 0.3 * 4e-5, 0.01 * 0.3 * 4e-5);
  EXPECT_NEAR(FittedEffect(beside[1].fit, 1).Value("offset"), 5e-5, 0.01 * 5e-5);
}

TEST(RankBeside, ABetterNameComesFirstWithItsSensitivities) {
  const GainBesideOffset c;
  const FitResult both = c.With({LinearCase::Offset(1e-5), GainBesideOffset::OffsetOfY(4e-5)});
  const std::vector<EffectInstance> found = {FittedEffect(both, 0), FittedEffect(both, 1)};
  const std::vector<RankedEffect> beside =
      RankBeside(c.model, {c.base, both, found}, 0, {LinearCase::Gain(1.1)}, kRejudgeN);
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_EQ(Named(beside[0].effect), "sensor-gain at A.x");
  EXPECT_NEAR(beside[0].effect.Value("gain"), 1.3, 1e-3);
  EXPECT_GT(beside[0].fit.jacobian.size(), 0);
  EXPECT_LT(beside[0].score, beside[1].score);
  EXPECT_NEAR(beside[0].score, Score(c.model, beside[0].fit, kRejudgeN), 1e-9);
}

// The second of two effects is judged in its own place.
TEST(RankBeside, TheEffectJudgedKeepsItsPlace) {
  const GainBesideOffset c;
  const FitResult both = c.With({LinearCase::Gain(1.2), GainBesideOffset::OffsetOfY(4e-5)});
  const std::vector<EffectInstance> found = {FittedEffect(both, 0), FittedEffect(both, 1)};
  EffectInstance gain_of_y = MakeInstance(EffectNamed("sensor-gain"), "A.y");
  gain_of_y.Set("gain", 1.1);  // of a reading that is held at nothing: it explains nothing
  const std::vector<RankedEffect> beside =
      RankBeside(c.model, {c.base, both, found}, 1, {gain_of_y}, kRejudgeN);
  EXPECT_EQ(Named(beside[0].effect), "sensor-offset at A.y");
  EXPECT_NEAR(beside[0].effect.Value("offset"), 5e-5, 1e-8);
  EXPECT_GT(beside[0].probability, 0.99);
}

}  // namespace
}  // namespace ambrig
