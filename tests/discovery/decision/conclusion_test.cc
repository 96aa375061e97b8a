// The verdict and what goes with it, from stages of a search whose residuals are written down.
#include "discovery/decision/conclusion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "discovery/decision/drift_test.h"
#include "discovery/search/likelihood.h"
#include "effects/catalogue.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

constexpr double kN = 300;
const UnitErrors kNoUnits;  // the rig file states no spread of the coils

/// Units that show so much in every channel of the four records.
UnitErrors Units(double ratio) { return {ratio, std::vector<double>(8, ratio)}; }

class Conclusion : public ::testing::Test {
 protected:
  /// A residual that is `of_record[r]` in every row of A.x of record r and nothing in A.y.
  std::vector<double> ResidualOf(const std::vector<double>& of_record) const {
    std::vector<double> r(case_.model.size(), 0);
    for (const Target& t : case_.model.targets())
      if (t.channel == 0)
        for (std::size_t k = t.first; k < t.first + t.count; ++k) r[k] = of_record[t.record];
    return r;
  }
  /// A fit that leaves `excess` floors rms in every record: A.x has it all.
  FitResult Leaving(double ratio) const {
    FitResult f;
    f.residual = ResidualOf(std::vector<double>(4, ratio * std::sqrt(2.0)));
    f.ratio_fit = Ratio(case_.model, f.residual, Which::kFit);
    f.ratio_validate = Ratio(case_.model, f.residual, Which::kValidate);
    f.converged = true;
    return f;
  }
  /// The same with one rig parameter that had to move by `shift` sd; in record r its column is
  /// `column[r]`, so that the record asks for residual/column more.
  FitResult Moved(double ratio, double shift, const std::vector<double>& column) const {
    FitResult f = Leaving(ratio);
    FreeParameter p;
    p.path = "bearings.A.gap";
    p.sd = p.step = 1e-6;
    p.start = 4e-4;
    p.value = p.start + shift * p.sd;
    f.hypothesis.free = {p};
    f.penalty = shift * shift;
    const std::vector<double> j = ResidualOf(column);
    f.jacobian = Eigen::Map<const Eigen::VectorXd>(j.data(), static_cast<Eigen::Index>(j.size()));
    return f;
  }
  RankedEffect Ranked(const EffectInstance& effect, double probability) const {
    RankedEffect r;
    r.effect = effect;
    r.probability = probability;
    return r;
  }

  LinearCase case_{{2e-5, 4e-5, 6e-5, 5e-5}, 1, 0};
};

TEST_F(Conclusion, RatiosAreRootMeanSquares) {
  FitResult f;
  f.residual = ResidualOf({2, 2, 8, 4});
  f.ratio_fit = Ratio(case_.model, f.residual, Which::kFit);
  f.ratio_validate = Ratio(case_.model, f.residual, Which::kValidate);
  const StageRatios r = RatiosOf(case_.model, f);
  EXPECT_DOUBLE_EQ(r.fit, std::sqrt((4 + 4 + 64) / 6.0));  // half of the rows are A.y
  EXPECT_DOUBLE_EQ(r.validate, std::sqrt(16 / 2.0));
  EXPECT_DOUBLE_EQ(r.worst_record, std::sqrt(64 / 2.0));
}

// Each record's own correction is (J'r)/(J'J) with information weight J'J; Q sums their squared
// distances from the mean. A twentieth of the shift of 4 sd adds to the variance of each.
TEST_F(Conclusion, DriftOfAParameterOverTheRecordsIsThatOfTheirCorrections) {
  FitResult f = Moved(1, 4, {1, 2, 1, 1});
  f.residual = ResidualOf({0.3, 0.2, -0.3, 0.1});
  const double weight = 0.01, rows = LinearCase::kRows;
  const std::vector<double> value = {0.3, 0.1, -0.3, 0.1};
  std::vector<double> information = {weight * rows, 4 * weight * rows, weight * rows,
                                     weight * rows};
  const DriftTest test = TestDrift(case_.model, f, 0, weight);
  EXPECT_NEAR(test.q, TestDrift(value, information, 0.2).q, 1e-12);
  double mean = 0, total = 0, q = 0;
  for (double& w : information) w = 1 / (1 / w + 0.2 * 0.2);
  for (std::size_t k = 0; k < 4; ++k) mean += information[k] * value[k], total += information[k];
  mean /= total;
  for (std::size_t k = 0; k < 4; ++k) q += information[k] * std::pow(value[k] - mean, 2);
  EXPECT_NEAR(test.q, q, 1e-12);
  EXPECT_EQ(test.freedom, 3);
}

TEST_F(Conclusion, AParameterThatMovedFarIsNamedWithWhatTheRecordsSayOfIt) {
  std::vector<std::string> warnings;
  const ParameterNeed need =
      NeedOf(case_.model, Moved(1, 4, {1, 1, 1, 1}), kN, warnings);  // all ask for the same
  EXPECT_NEAR(need.largest_shift, 4, 1e-9);
  EXPECT_FALSE(need.possible);  // 16 of 1 prior
  EXPECT_TRUE(need.constant);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("bearings.A.gap had to move by +4.0 sd"));
  EXPECT_THAT(warnings[0], HasSubstr("the records agree on that (Q = 0.0, 3 degrees of freedom)"));
}

TEST_F(Conclusion, RecordsThatDoNotAgreeOnAParameterAreSaidSo) {
  std::vector<std::string> warnings;
  const ParameterNeed need = NeedOf(case_.model, Moved(5, -3.5, {1, -1, 1, -1}), 1e4, warnings);
  EXPECT_NEAR(need.largest_shift, 3.5, 1e-9);
  EXPECT_FALSE(need.constant);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("-3.5 sd; the records do not agree on one value"));
}

TEST_F(Conclusion, ASmallShiftNeedsNoWord) {
  std::vector<std::string> warnings;
  const ParameterNeed need = NeedOf(case_.model, Moved(1, 1.2, {1, 1, 1, 1}), kN, warnings);
  EXPECT_NEAR(need.largest_shift, 1.2, 1e-9);
  EXPECT_TRUE(need.possible);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(Conclusion, AnEffectThatClosesTheErrorIsTheVerdict) {
  Explanation out;
  out.effective_sample_size = kN;
  out.adopted = {LinearCase::Gain(1.08)};
  out.ranking = {Ranked(out.adopted[0], 0.98), Ranked(LinearCase::Offset(1e-6), 0.02)};
  Conclude(case_.model, Leaving(6), Leaving(5), Leaving(1), kNoUnits, out);
  EXPECT_EQ(out.verdict, ExplanationVerdict::kEffect);
  EXPECT_EQ(out.adopted.size(), 1u);
  EXPECT_NEAR(out.closure.explained, 1, 1e-12);
  EXPECT_NEAR(out.closure.floors_before, 5, 1e-12);
  EXPECT_NEAR(out.closure.test_after, 1, 1e-12);
  EXPECT_EQ(out.set[0].effect, "sensor-gain");
  EXPECT_GT(out.set[0].probability, 0.9);
}

// What leaves more than it explains is a patch on something unknown.
TEST_F(Conclusion, APatchIsWithdrawn) {
  Explanation out;
  out.effective_sample_size = kN;
  out.adopted = {LinearCase::Gain(1.08)};
  out.ranking = {Ranked(out.adopted[0], 1)};
  Conclude(case_.model, Leaving(6), Leaving(5), Leaving(4.5), kNoUnits, out);
  EXPECT_EQ(out.verdict, ExplanationVerdict::kUnknown);
  EXPECT_TRUE(out.adopted.empty());
  EXPECT_EQ(out.set[0].effect, "unknown");
  EXPECT_EQ(out.remainder.kind, RemainderKind::kOther);
}

// Two thirds explained by a name without rivals stand; by one that another contests they do not.
TEST_F(Conclusion, AContestedNameThatLeavesMuchIsWithdrawn) {
  for (const double probability : {0.98, 0.5}) {
    Explanation out;
    out.effective_sample_size = kN;
    out.adopted = {LinearCase::Gain(1.08)};
    out.ranking = {Ranked(out.adopted[0], probability),
                   Ranked(LinearCase::Offset(1e-6), 1 - probability)};
    Conclude(case_.model, Leaving(6), Leaving(5), Leaving(2.7), kNoUnits, out);
    EXPECT_NEAR(out.closure.explained, (25 - 2.7 * 2.7) / 24, 1e-9);
    EXPECT_EQ(out.verdict,
              probability > 0.9 ? ExplanationVerdict::kEffect : ExplanationVerdict::kUnknown)
        << probability;
    EXPECT_EQ(out.adopted.empty(), probability < 0.9) << probability;
  }
}

// A pull that holds the shaft back is no motor's where much else stays too: a spring with play, a
// rub. Where it explains nearly all it keeps its name, and a line says that no motor does this.
TEST_F(Conclusion, APullOfTheWrongSignIsWithdrawnWhereMuchStays) {
  for (const double stiffness : {-4e4, 4e4})
    for (const double left : {1.0, 1.5, 2.5}) {
      EffectInstance pull = MakeInstance(EffectNamed("side-pull"), "A");
      pull.Set("stiffness", stiffness);
      Explanation out;
      out.effective_sample_size = kN;
      out.adopted = {pull};
      out.ranking = {Ranked(pull, 1)};
      Conclude(case_.model, Leaving(6), Leaving(5), Leaving(left), kNoUnits, out);
      const bool withdrawn = stiffness < 0 && left > 2;
      EXPECT_EQ(out.verdict, withdrawn ? ExplanationVerdict::kUnknown : ExplanationVerdict::kEffect)
          << stiffness << ", " << left;
      EXPECT_EQ(out.adopted.empty(), withdrawn);
      const auto told = std::ranges::count_if(out.warnings, [](const std::string& line) {
        return line.starts_with("side-pull at A has the opposite sign");
      });
      EXPECT_EQ(told, stiffness < 0 && !withdrawn ? 1 : 0);
    }
}

// What is left of the coils' errors in any machine of the type is nothing unknown.
TEST_F(Conclusion, WhatOtherUnitsLeaveTooIsOfTheParameters) {
  for (const double units :
       {1.5, 2.0}) {  // A.x leaves 1.3 times the root of two; a tenth more may be chance
    Explanation out;
    out.effective_sample_size = kN;
    Conclude(case_.model, Leaving(1.4), Leaving(1.3), Leaving(1.3), Units(units), out);
    EXPECT_EQ(out.verdict,
              units > 1.6 ? ExplanationVerdict::kParameters : ExplanationVerdict::kUnknown);
    EXPECT_EQ(out.remainder.text.find("errors of the coils") != std::string::npos, units > 1.6);
  }
}

// Nor beside an effect: it is no reason to doubt the name.
TEST_F(Conclusion, WhatOtherUnitsLeaveTooIsNotLeftUnexplained) {
  for (const double units : {2.7, 4.0}) {
    Explanation out;
    out.effective_sample_size = kN;
    out.adopted = {LinearCase::Gain(1.08)};
    out.ranking = {Ranked(out.adopted[0], 0.5), Ranked(LinearCase::Offset(1e-6), 0.5)};
    Conclude(case_.model, Leaving(6), Leaving(5), Leaving(2.7), Units(units), out);
    EXPECT_EQ(out.adopted.size(), units > 3 ? 1U : 0U);
    EXPECT_EQ(out.verdict, units > 3 ? ExplanationVerdict::kEffect : ExplanationVerdict::kUnknown);
    EXPECT_EQ(out.remainder.text.find("errors of the coils") != std::string::npos, units > 3);
  }
}

TEST_F(Conclusion, WithoutAnyMisfitTheSetHoldsNone) {
  Explanation out;
  out.effective_sample_size = kN;
  Conclude(case_.model, Leaving(1), Leaving(1), Leaving(1), kNoUnits, out);
  EXPECT_EQ(out.verdict, ExplanationVerdict::kNone);
  ASSERT_EQ(out.set.size(), 1u);
  EXPECT_EQ(out.set[0].effect, "none");
  EXPECT_DOUBLE_EQ(out.set[0].probability, 1);
}

TEST_F(Conclusion, WrongDataAreAVerdictOfTheirOwn) {
  Explanation out;
  DataFault f;
  f.probability = 0.7;
  out.data = {f};
  ConcludeData(case_.model, Leaving(50), out);
  EXPECT_EQ(out.verdict, ExplanationVerdict::kData);
  ASSERT_EQ(out.set.size(), 2u);
  EXPECT_EQ(out.set[0].effect, "data");
  EXPECT_EQ(out.set[1].effect, "unknown");
  EXPECT_NEAR(out.set[1].probability, 0.3, 1e-12);
  EXPECT_THAT(out.remainder.text, HasSubstr("the data are wrong"));
  out.data[0].probability = 0.99;
  ConcludeData(case_.model, Leaving(50), out);
  EXPECT_EQ(out.set.size(), 1u);
}

// A remainder is of the law's own detail only where nine tenths are closed in every channel.
TEST_F(Conclusion, TheRemainderNamesTheWorstPlaceAndItsOrigin) {
  const std::vector<double> before = ResidualOf({20, 20, 20, 20}), after = ResidualOf({2, 2, 4, 2});
  const Closure closure = ClosureOf(case_.model, before, after);
  const Remainder law = RemainderOf(case_.model, before, after, closure, true);
  EXPECT_EQ(law.kind, RemainderKind::kLawVariation);
  ASSERT_EQ(law.where.size(), 4u);
  EXPECT_EQ(law.where[0].record, "at 6e-05 m");
  EXPECT_EQ(law.where[0].channel, "A.x");
  EXPECT_DOUBLE_EQ(law.where[0].ratio, 4);
  EXPECT_EQ(RemainderOf(case_.model, before, after, closure, false).kind, RemainderKind::kOther);
  const std::vector<double> patch = ResidualOf({1, 1, 18, 1});
  EXPECT_EQ(
      RemainderOf(case_.model, before, patch, ClosureOf(case_.model, before, patch), true).kind,
      RemainderKind::kOther);
  const std::vector<double> floor = ResidualOf({1, 1, 1, 1});
  const Remainder nothing =
      RemainderOf(case_.model, before, floor, ClosureOf(case_.model, before, floor), true);
  EXPECT_EQ(nothing.kind, RemainderKind::kNone);
  EXPECT_TRUE(nothing.where.empty());
}

// Twice the error costs what the misfit says, split by the rows of both kinds; a second kind of
// effect costs more than a second place of the same.
TEST_F(Conclusion, TheScorePricesErrorNumbersAndLaws) {
  const double plain = Score(case_.model, 1, 1, kN, 0, 0);
  EXPECT_DOUBLE_EQ(plain, 0);
  EXPECT_NEAR(Score(case_.model, 2, 1, kN, 0, 0), 0.75 * Misfit(2, kN), 1e-9);
  EXPECT_NEAR(Score(case_.model, 1, 2, kN, 0, 0), 0.25 * Misfit(2, kN), 1e-9);
  EXPECT_NEAR(Score(case_.model, 0.5, 0.5, kN, 0, 0), 0, 1e-12);  // below the floor is no better
  EXPECT_NEAR(Score(case_.model, 1, 1, kN, 2, 3.5), 2 * std::log(kN) + 3.5, 1e-12);
  FitResult f = Leaving(1);
  f.hypothesis = case_.With({LinearCase::Gain(1.01)});
  const double one = Score(case_.model, f, kN);
  EffectInstance y = LinearCase::Gain(1.01);
  y.target = "A.y";
  f.hypothesis = case_.With({LinearCase::Gain(1.01), y});
  const double same_law = Score(case_.model, f, kN);
  f.hypothesis = case_.With({LinearCase::Gain(1.01), LinearCase::Offset(1e-6)});
  const double other_law = Score(case_.model, f, kN);
  EXPECT_NEAR(same_law - one, std::log(kN), 1e-9);
  EXPECT_GT(other_law - one, same_law - one);
}

}  // namespace
}  // namespace ambrig
