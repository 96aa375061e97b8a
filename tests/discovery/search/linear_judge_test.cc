// Signatures, linear steps and rankings on readings that are linear in gain and offset.
#include "discovery/search/linear_judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/search/likelihood.h"
#include "discovery/search/screen.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kJudgeN = 300;  // independent numbers
const std::vector<double> kJudgeX = {2e-5, 4e-5, 6e-5, 5e-5};

/// A bank with the probes of sensor-gain and sensor-offset at A.x, in this order.
SignatureBank BankOf(const LinearCase& c, const FitResult& base) {
  SignatureBank bank;
  for (const char* id : {"sensor-gain", "sensor-offset"})
    bank.Simulate(c.model, base, ProbesOf(EffectNamed(id), "A.x", c.model, {}), nullptr);
  return bank;
}

const SignatureBank::Entry& EntryOf(const SignatureBank& bank, const std::string& effect) {
  for (const SignatureBank::Entry& e : bank.entries())
    if (e.group.probes[0].name == effect) return e;
  throw std::runtime_error("no entry of " + effect);
}

/// What a probe changes in a reading at position x [m].
double Change(const EffectInstance& probe, double x) {
  return probe.name == "sensor-gain" ? (probe.Value("gain") - 1) * x : probe.Value("offset");
}

TEST(SignatureBank, ProductsAreSumsOverTheRowsOfEitherKind) {
  const LinearCase c(kJudgeX, 1, 0);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  const Gram& g = bank.Products(c.model);
  for (const SignatureBank::Entry& a : bank.entries())
    for (const SignatureBank::Entry& b : bank.entries()) {
      double fit = 0, validate = 0;
      for (std::size_t r = 0; r < kJudgeX.size(); ++r)
        (r < c.fit_records() ? fit : validate) +=
            LinearCase::kRows * Change(a.group.probes[0], kJudgeX[r]) *
            Change(b.group.probes[0], kJudgeX[r]) / (LinearCase::kFloor * LinearCase::kFloor);
      EXPECT_NEAR(g.fit(a.first, b.first), fit, 1e-5 * std::abs(fit));
      EXPECT_NEAR(g.validate(a.first, b.first), validate, 1e-5 * std::abs(validate));
    }
  EXPECT_TRUE(bank.Holds(EntryOf(bank, "sensor-gain").group.probes[0]));
  EXPECT_FALSE(bank.Holds(LinearCase::Gain(1.2345)));
}

TEST(SignatureBank, ProductsWithOneColumnAreThoseOfTheDefinition) {
  const LinearCase c(kJudgeX, 1, 0);
  const FitResult base = c.Base();
  const SignatureBank bank = BankOf(c, base);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(c.model.size()), 1);
  const Gram g = bank.ProductsWith(c.model, ones);
  const SignatureBank::Entry& e = EntryOf(bank, "sensor-offset");
  const double size = e.group.probes[0].Value("offset") / LinearCase::kFloor;
  EXPECT_NEAR(g.fit(0, e.first), 3 * LinearCase::kRows * size, 1e-5 * std::abs(150 * size));
  EXPECT_NEAR(g.validate(0, e.first), LinearCase::kRows * size, 1e-5 * std::abs(50 * size));
  const Gram rows = RowProducts(c.model, ones, ones);  // A.x and A.y
  EXPECT_EQ(rows.fit(0, 0), 2 * 3 * LinearCase::kRows);
  EXPECT_EQ(rows.validate(0, 0), 2 * LinearCase::kRows);
}

TEST(LinearJudge, OneStepFindsTheOffsetOfTheData) {
  const LinearCase c(kJudgeX, 1, 7e-6);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  const Candidate found =
      LinearJudge(c.model, base, bank, kJudgeN).Single(EntryOf(bank, "sensor-offset"));
  EXPECT_NEAR(found.effect.Value("offset"), 7e-6, 1e-10);
  // Products are in single precision: of a ratio of 5, √1e-7 of it may stay.
  EXPECT_LT(found.ratio_fit, 5e-3);
  EXPECT_LT(found.ratio_validate, 5e-3);
  EXPECT_NEAR(found.score, Score(c.model, 0, 0, kJudgeN, 1, 0),
              1e-9);  // one number, no misfit
}

// Beside its true frequency a resonance seems smaller than it is: twice its size is tried as well.
TEST(LinearJudge, AResonanceIsAlsoTriedAtTwiceItsSize) {
  const LinearCase c(kJudgeX, 1, 7e-6);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  SignatureBank::Entry entry = EntryOf(bank, "sensor-offset");
  const LinearJudge judge(c.model, base, bank, kJudgeN);
  EXPECT_TRUE(judge.Single(entry).other_starts.empty());
  entry.group.narrow = true;
  entry.group.linear = false;  // one probe of finite size, scaled about 1
  entry.group.scaling = {{entry.group.rows[0], 1.0}};
  const Candidate found = judge.Single(entry);
  ASSERT_EQ(found.other_starts.size(), 1u);
  EXPECT_NEAR(found.effect.Value("offset"), 7e-6, 1e-9);
  EXPECT_NEAR(found.other_starts[0].Value("offset"), 14e-6, 2e-9);
}

// Of clamped rotors nothing moves: no motion is left to explain.
TEST(LinearJudge, WithoutAFreeRotorNoMotionIsOpen) {
  const LinearCase c(kJudgeX, 1, 7e-6);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  EXPECT_EQ(LinearJudge(c.model, base, bank, kJudgeN).MotionShare(EntryOf(bank, "sensor-gain")), 1);
}

TEST(SignatureBank, NewFloorsScaleWhatWasSimulated) {
  LinearCase c(kJudgeX, 1, 7e-6);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  const Gram old = bank.Products(c.model);
  const std::vector<Target> before = c.model.targets();
  for (Target& t : c.model.targets()) t.floor = 2 * LinearCase::kFloor;
  bank.Rescale(c.model, before);
  const Gram& now = bank.Products(c.model);
  EXPECT_LT((4 * now.fit - old.fit).norm(), 1e-5 * old.fit.norm());
  EXPECT_LT((4 * now.validate - old.validate).norm(), 1e-5 * old.validate.norm());
}

// A gain cannot make an offset: Σ (o - a x)² is least for a = o Σ x/Σ x², over A.x and A.y.
TEST(LinearJudge, TheWrongEffectLeavesTheErrorOfLeastSquares) {
  const double o = 7e-6;
  const LinearCase c(kJudgeX, 1, o);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  const Candidate found =
      LinearJudge(c.model, base, bank, kJudgeN).Single(EntryOf(bank, "sensor-gain"));
  double s = 0, ss = 0;
  for (std::size_t r = 0; r < c.fit_records(); ++r) s += kJudgeX[r], ss += kJudgeX[r] * kJudgeX[r];
  const double a = o * s / ss, n = 2 * static_cast<double>(c.fit_records());
  double left = 0;
  for (std::size_t r = 0; r < c.fit_records(); ++r) left += std::pow(o - a * kJudgeX[r], 2);
  EXPECT_NEAR(found.effect.Value("gain"), 1 + a, 1e-6);
  EXPECT_NEAR(found.ratio_fit, std::sqrt(left / n) / LinearCase::kFloor, 1e-3);
  EXPECT_NEAR(found.ratio_validate,
              std::abs(o - a * kJudgeX.back()) / std::sqrt(2.0) / LinearCase::kFloor, 1e-4);
}

// An effect that is fitted already has no drawing to stay near: it moves without a penalty when
// another one joins it.
TEST(LinearJudge, AFittedEffectMovesWithoutAPenalty) {
  const LinearCase c(kJudgeX, 1.1, 7e-6);
  const FitResult base = Fit(c.model, c.With({LinearCase::Gain(1.05)}), {});
  ASSERT_TRUE(base.converged);
  ASSERT_GT(base.hypothesis.rig.effects[0].Value("gain"), 1.15);  // takes up the offset
  SignatureBank bank = BankOf(c, base);
  const Candidate found =
      LinearJudge(c.model, base, bank, kJudgeN).Single(EntryOf(bank, "sensor-offset"));
  EXPECT_NEAR(found.effect.Value("offset"), 7e-6, 1e-8);
  EXPECT_NEAR(found.score, Score(c.model, 0, 0, kJudgeN, 1, 0), 1e-2);
}

TEST(LinearJudge, APairSolvesBothAtOnce) {
  const LinearCase c(kJudgeX, 1.06, -4e-6);
  const FitResult base = c.Base();
  SignatureBank bank = BankOf(c, base);
  const LinearJudge judge(c.model, base, bank, kJudgeN);
  const CandidatePair pair =
      judge.Pair(EntryOf(bank, "sensor-gain"), EntryOf(bank, "sensor-offset"));
  EXPECT_NEAR(pair.first.Value("gain"), 1.06, 1e-5);
  EXPECT_NEAR(pair.second.Value("offset"), -4e-6, 1e-9);
  EXPECT_LT(pair.ratio_validate, 5e-3);
  for (const char* one : {"sensor-gain", "sensor-offset"})
    EXPECT_GT(judge.Single(EntryOf(bank, one)).ratio_fit, pair.ratio_fit) << one;
  const auto pairs = ScreenPairs(c.model, base, kJudgeN, bank, 3);
  ASSERT_FALSE(pairs.empty());
  EXPECT_NEAR(pairs[0].score, pair.score, 1e-9);
}

// An effect of the catalogue is found among those of the same plane, at its size, and by its price.
TEST(Screen, TheEffectThatMadeTheDataIsRankedFirst) {
  const LinearCase c(kJudgeX, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  ScreenOptions options;
  options.effective_sample_size = kJudgeN;
  options.target = "A.x";
  const std::vector<Candidate> all = Screen(c.model, base, {}, options, bank);
  ASSERT_GE(all.size(), 2U);
  EXPECT_EQ(all[0].effect.name, "sensor-gain");
  EXPECT_NEAR(all[0].effect.Value("gain"), 1.08, 1e-5);
  for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k - 1].score, all[k].score);
}

}  // namespace
}  // namespace ambrig
