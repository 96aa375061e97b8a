// Iron whose law is of another form than the catalogue's keeps its name, because the law's shape is
// fitted.
#include "discovery/shape/shape_names.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "discovery/shape/shape.h"
#include "effects/law_tables.h"
#include "tests/discovery/shape/held_case.h"

namespace ambrig {
namespace {

constexpr double kShapeN = 2000;

struct RankedTwice {
  std::vector<RankedEffect> before, after;
};

RankedTwice RankTwice(const std::vector<EffectInstance>& truth) {
  const HeldIron held(truth);
  FitOptions options;
  options.effective_sample_size = kShapeN;
  const FitResult base = Fit(*held.model, Hypothesis::Base(held.data.rig), options);
  SignatureBank bank;
  const RoundSetting setting = {*held.model, *held.model, bank,
                                kShapeN,     3,           [](double, const std::string&) {}};
  RankedTwice out;
  out.before = out.after = RankEffects(setting, base, 0).ranking;
  JudgeByShape(setting, base, 0, out.after);
  return out;
}

const RankedEffect* NamedIn(const std::vector<RankedEffect>& ranking, const std::string& name) {
  for (const RankedEffect& r : ranking)
    if (r.effect.name == name && r.effect.target == "A") return &r;
  return nullptr;
}

// Neither law of the catalogue follows a ring that holds back a part of the flux; the free shape
// does.
TEST(JudgeByShape, AClosedRingIsEddyCurrents) {
  const RankedTwice judged = RankTwice({IronAtA("eddy-impedance", {{"r3", 0.06}, {"r4", 0.04}})});
  const RankedEffect& best = judged.after.at(0);
  EXPECT_EQ(Named(best.effect), "eddy-currents at A");
  EXPECT_GT(best.fit.ratio_fit, 1.5);
  ASSERT_TRUE(best.shaped);
  EXPECT_LT(best.RatioFit(), 1.05);
  EXPECT_GT(best.probability, 0.95);
}

// Free relaxations come near to loops of two widths, nearer than the catalogue's diffusion by far;
// free operators are these loops.
TEST(JudgeByShape, LoopsOfTwoWidthsStayHysteresis) {
  const RankedTwice judged =
      RankTwice({IronAtA("hysteresis", {{"coercive", 0.05}, {"width", 0.02}}),
                 IronAtA("hysteresis", {{"coercive", 0.08}, {"width", 0.25}})});
  const RankedEffect& best = judged.after.at(0);
  EXPECT_EQ(Named(best.effect), "hysteresis at A");
  EXPECT_LT(best.RatioFit(), 1.03);
  EXPECT_GT(best.probability, 0.99);
  const RankedEffect* eddy = NamedIn(judged.after, "eddy-currents");
  ASSERT_TRUE(eddy);
  EXPECT_LT(eddy->RatioFit(), eddy->fit.ratio_fit - 0.2);
}

// H = c tan(pi B/(2 B_s)): a slope at low flux, which rises from there. Neither law of the
// catalogue has both.
TEST(JudgeByShape, ACurveThatStartsWithASlopeAndSaturatesIsOfBothNames) {
  std::vector<std::pair<std::string, double>> tangent = {{"reach", 1.0}};
  for (int k = 0; k < kBhNodes; ++k) {
    const double B = k / (kBhNodes - 1.0);
    tangent.emplace_back("path" + std::to_string(k),
                         4e-5 / std::pow(std::cos(kPi / 2 * B / 1.2), 2));
  }
  const RankedTwice judged = RankTwice({IronAtA("bh-curve", tangent)});
  const RankedEffect* path = NamedIn(judged.after, "iron-reluctance");
  const RankedEffect* knee = NamedIn(judged.after, "saturation");
  ASSERT_TRUE(path && knee);
  EXPECT_GT(path->probability, 0.1);
  EXPECT_GT(knee->probability, 0.1);
  EXPECT_GT(path->probability + knee->probability, 0.99);
}

TEST(SaturatingShare, IsTheRiseBeyondTheLeastPath) {
  EXPECT_EQ(SaturatingShare({2, 2, 2}), 0);     // reluctance
  EXPECT_EQ(SaturatingShare({4, 3, 2}), 0);     // with a threshold
  EXPECT_EQ(SaturatingShare({0, 0, 5}), 1);     // a knee
  EXPECT_EQ(SaturatingShare({1, 1, 2}), 0.25);  // both
  EXPECT_EQ(SaturatingShare({0, 0, 0}), 0);
}

// A law that is exact and uncontested is not asked for its shape.
TEST(JudgeByShape, LeavesAnExactLawAsItIs) {
  const RankedTwice judged = RankTwice({IronAtA("eddy-sleeve", {{"cutoff", 4000}})});
  ASSERT_FALSE(judged.after.empty());
  EXPECT_EQ(Named(judged.after[0].effect), "eddy-currents at A");
  for (std::size_t k = 0; k < judged.after.size(); ++k) {
    EXPECT_FALSE(judged.after[k].shaped);
    EXPECT_EQ(judged.after[k].probability, judged.before[k].probability);
  }
}

}  // namespace
}  // namespace ambrig
