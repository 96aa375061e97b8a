// Forces of the motion whose law is of another form than the catalogue's: what the law leaves its
// free shape explains, and the name is told from those that only resemble it.
#include <gtest/gtest.h>

#include "discovery/practice/laws/practice_law.h"
#include "discovery/shape/shape_names.h"
#include "tests/discovery/shape/pushed_rotor.h"

namespace ambrig {
namespace {

/// The ranking of one round against a machine with `truth`, judged by the shapes of the laws.
std::vector<RankedEffect> JudgedRound(const EffectInstance& truth) {
  const PushedRotor rotor(truth);
  const CaseModel& model = *rotor.model;
  FitOptions options;
  options.effective_sample_size = kMotionN;
  const FitResult base = Fit(model, Hypothesis::Base(rotor.data.rig), options);
  SignatureBank bank;
  const RoundSetting setting = {model, model, bank, kMotionN, 3, [](double, const std::string&) {}};
  std::vector<RankedEffect> ranking = RankEffects(setting, base, 0).ranking;
  JudgeByShape(setting, base, 0, ranking);
  return ranking;
}

/// The name comes first, its law leaves more than noise and the law's shape at most `most`.
void ExpectNamedByItsShape(const EffectInstance& truth, const std::string& name, double most) {
  const std::vector<RankedEffect> ranking = JudgedRound(truth);
  const RankedEffect& best = ranking.at(0);
  EXPECT_EQ(Named(best.effect), name);
  EXPECT_GT(best.fit.ratio_fit, 1.2);
  ASSERT_TRUE(best.shaped);
  EXPECT_LT(best.RatioFit(), most);
}

// A cross-coupling that falls off with the orbit.
TEST(JudgeMotionByShape, ACrossCouplingOfTheOrbitKeepsItsName) {
  const std::string k = "(30000 / (1 + (x * x + y * y) / 9e-10))";
  ExpectNamedByItsShape(FormulaAt("A", {{"force.x", "-" + k + " * y"}, {"force.y", k + " * x"}}),
                        "cross-coupling at A", 1.05);
}

// A coupling with a backward second and a fourth order beside the second one.
TEST(JudgeMotionByShape, ACouplingOfManyOrdersKeepsItsName) {
  ExpectNamedByItsShape(
      FormulaAt("A", {{"force.x", "3*cos(2*theta+1) + 0.6*cos(2*theta) + 0.4*cos(4*theta)"},
                      {"force.y", "3*sin(2*theta+1) - 0.6*sin(2*theta) + 0.4*sin(4*theta)"}}),
      "coupling-misalignment at A", 1.03);
}

// A spring that takes hold beyond some play holds the shaft back: no motor does that, whatever its
// shape.
TEST(JudgeMotionByShape, APullThatHoldsTheShaftBackIsNotAskedForItsShape) {
  const std::string f =
      "(-60000 * max(sqrt(x*x + y*y + 1e-20) - 5e-6, 0) / sqrt(x*x + y*y + 1e-20))";
  for (const RankedEffect& r :
       JudgedRound(FormulaAt("A", {{"force.x", f + " * x"}, {"force.y", f + " * y"}})))
    if (r.effect.name == "side-pull") {
      EXPECT_FALSE(r.shaped);
    }
}

}  // namespace
}  // namespace ambrig
