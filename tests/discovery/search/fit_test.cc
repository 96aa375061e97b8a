// The fit on problems that are linear in the unknowns: optimum, covariance, warnings in closed
// form.
#include "discovery/search/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "discovery/model/jacobian.h"
#include "discovery/search/likelihood.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kFitX[] = {2e-5, 4e-5, 6e-5, 5e-5};

LinearCase CaseOf(double gain, double offset) {
  return {{std::begin(kFitX), std::end(kFitX)}, gain, offset};
}

/// A reading of A.x that is a formula of x and of a parameter k between 0 and 1.
std::vector<EffectInstance> ReadingOfK(const std::string& reading, double k) {
  const std::string file =
      std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string effect = fmt::format(
      "\n[[effect]]\nname = \"formula\"\ntarget = \"A\"\n"
      "parameters = {{ k = {{ value = {}, null = 0.0, min = 0.0, max = 1.0 }} }}\n"
      "reading = {{ x = \"{}\", y = \"y\" }}\n",
      k, reading);
  return ReadRigText(text + effect, "rig.toml").effects;
}

// d(gain x)/d(gain) = x, in units of the floor, per step of the coordinate; no other row moves.
TEST(Jacobian, IsTheDerivativeOfALinearReading) {
  const LinearCase c = CaseOf(1, 0);
  const Hypothesis h = c.With({LinearCase::Gain(1.02), LinearCase::Offset(1e-6)});
  const Eigen::MatrixXd J = Jacobian(c.model, h, {0, 1});
  for (const Target& t : c.model.targets()) {
    const bool moves = t.channel == 0;  // A.x
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      EXPECT_NEAR(J(row, 0), moves ? c.x[t.record] / LinearCase::kFloor * h.free[0].step : 0, 1e-8);
      EXPECT_NEAR(J(row, 1), moves ? h.free[1].step / LinearCase::kFloor : 0, 1e-8);
    }
  }
}

// The differences turn round where the parameter stands at its upper bound.
TEST(Jacobian, AtTheUpperBoundItLooksBack) {
  const LinearCase c = CaseOf(1, 0);
  Hypothesis h = c.With({LinearCase::Gain(1.02)});
  h.free[0].hi = h.free[0].value;
  const Eigen::MatrixXd J = Jacobian(c.model, h, {0});
  EXPECT_NEAR(J(0, 0), kFitX[0] / LinearCase::kFloor * h.free[0].step, 1e-8);
}

// Both sides of a linear reading are the same; at a bound only one is there.
TEST(Jacobian, TwoSidedIsTheSameWhereTheReadingIsLinear) {
  const LinearCase c = CaseOf(1, 0);
  Hypothesis h = c.With({LinearCase::Gain(1.02), LinearCase::Offset(1e-6)});
  const Eigen::MatrixXd one = Jacobian(c.model, h, {0, 1}),
                        two =
                            Jacobian(c.model, h, {0, 1}, 0.3, nullptr, DifferenceSides::kTwoSided);
  EXPECT_LT((one - two).norm(), 1e-6 * one.norm());
  h.free[0].hi = h.free[0].value;
  const Eigen::MatrixXd bound =
      Jacobian(c.model, h, {0, 1}, 0.3, nullptr, DifferenceSides::kTwoSided);
  EXPECT_LT((one - bound).norm(), 1e-6 * one.norm());
}

// A reading that jumps by 10 um where k passes 0.5, and nowhere else depends on it: from 0.45 a
// step of 0.1 crosses that on one side only, which is no slope.
TEST(Jacobian, TwoSidedTakesNoJumpForASlope) {
  Case jumping = LinearCase::Make({2e-5, 4e-5}, 1, 0);
  jumping.rig.effects = ReadingOfK("x + (k > 0.5 ? 1e-5 : 0)", 0.45);
  const CaseModel model(jumping);
  const Hypothesis h = Hypothesis::Base(jumping.rig);
  ASSERT_EQ(h.free.size(), 1u);
  Hypothesis beyond = h;
  beyond.Set(0, 0.55);
  const double fraction = beyond.Coordinate(0) - h.Coordinate(0);
  EXPECT_GT(Jacobian(model, h, {0}, fraction).norm(), 0);
  EXPECT_EQ(Jacobian(model, h, {0}, fraction, nullptr, DifferenceSides::kTwoSided).norm(), 0);
}

// A reading that bends, x + 0.1 mm k²: a step of 0.5 from k = 0.1 moves it by 35 floors, three and
// a half times as much as its slope says, and is taken again smaller.
TEST(Jacobian, AStepThatMovesMuchIsTakenSmaller) {
  Case bent = LinearCase::Make({2e-5, 4e-5}, 1, 0);
  bent.rig.effects = ReadingOfK("x + 1e-4 * k * k", 0.1);
  CaseModel model(bent);
  for (Target& t : model.targets()) t.floor = LinearCase::kFloor;
  const Hypothesis h = Hypothesis::Base(bent.rig);
  Hypothesis beyond = h, beside = h;
  beyond.Set(0, 0.6);
  beside.Set(0, 0.1001);
  const Eigen::MatrixXd J = Jacobian(model, h, {0}, beyond.Coordinate(0) - h.Coordinate(0));
  const double per_unit = 0.0001 / (beside.Coordinate(0) - h.Coordinate(0)),
               slope = 2 * 1e-4 * 0.1 / LinearCase::kFloor * per_unit;
  EXPECT_NEAR(J(0, 0), slope, 0.15 * slope);
}

// With a look at one record the rows of the others stay zero.
TEST(Jacobian, OfSomeRecordsLeavesTheOthersZero) {
  const LinearCase c = CaseOf(1, 0);
  const Hypothesis h = c.With({LinearCase::Gain(1.02)});
  const RecordSubset look{{0, 1, 0, 0}, std::vector<double>(c.model.size(), 0.0)};
  const Eigen::MatrixXd all = Jacobian(c.model, h, {0}),
                        some = Jacobian(c.model, h, {0}, 0.3, &look);
  for (const Target& t : c.model.targets()) {
    const auto row = static_cast<Eigen::Index>(t.first);
    EXPECT_DOUBLE_EQ(some(row, 0), t.record == 1 ? all(row, 0) : 0);
  }
  EXPECT_NE(some.norm(), 0);
}

// Data of gain 1.07 and offset 3 um, fitted by an offset on the record at 20 um alone:
// 0.07 * 20 + 3.
TEST(Fit, LooksAtTheNamedRecordsOnlyAndJudgesOnAll) {
  const LinearCase c = CaseOf(1.07, 3e-6);
  FitOptions options;
  options.effective_sample_size = 300;
  options.records = {1, 0, 0, 0};
  const FitResult fit = Fit(c.model, c.With({LinearCase::Offset(1e-6)}), options);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(FittedEffect(fit, 0).Value("offset"), 4.4e-6, 5e-8);
  EXPECT_GT(fit.ratio_fit, 1);                        // the other fitted records do not agree
  EXPECT_NE(fit.jacobian.bottomRows(100).norm(), 0);  // sensitivities of all, unseen ones too
}

TEST(Fit, FindsGainAndOffsetThatMadeTheData) {
  const LinearCase c = CaseOf(1.07, 3e-6);
  FitOptions options;
  options.effective_sample_size = 300;
  const FitResult fit =
      Fit(c.model, c.With({LinearCase::Gain(1.01), LinearCase::Offset(1e-6)}), options);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(FittedEffect(fit, 0).Value("gain"), 1.07, 2e-3);
  EXPECT_NEAR(FittedEffect(fit, 1).Value("offset"), 3e-6, 1e-7);
  EXPECT_LT(fit.ratio_fit, 0.05);
  EXPECT_LT(fit.ratio_validate, 0.05);  // the record kept back has the same law
  EXPECT_EQ(fit.penalty, 0);            // neither has a prior
}

// Where the reading is linear one set of sensitivities tells every step. Fitted records: three
// predictions as sampled of the start and of each step, and once three coarse ones of the start and
// of each parameter moved.
TEST(Fit, TakesSensitivitiesOnceWhereTheyTellTheSteps) {
  const LinearCase c = CaseOf(1.07, 3e-6);
  FitOptions options;
  options.effective_sample_size = 300;
  options.sensitivities = false;
  options.passes = 1;
  const FitResult fit =
      Fit(c.model, c.With({LinearCase::Gain(1.01), LinearCase::Offset(1e-6)}), options);
  EXPECT_NEAR(FittedEffect(fit, 0).Value("gain"), 1.07, 2e-3);
  const auto records = static_cast<long>(c.fit_records());
  const long without_sensitivities = c.model.runs - 3 * records;
  EXPECT_LE(without_sensitivities, records * (1 + options.iterations) + 1);  // 1: the unseen record
}

// weight² Jᵀ J with weight² = n/rows at the noise floor: sd = floor / √(n/rows Σ x²).
TEST(Fit, StandardDeviationIsThatOfTheLinearProblem) {
  const LinearCase c = CaseOf(1.07, 0);
  FitOptions options;
  options.effective_sample_size = 120;
  const FitResult fit = Fit(c.model, c.With({LinearCase::Gain(1.02)}), options);
  double sum = 0;
  for (std::size_t r = 0; r < c.fit_records(); ++r) sum += LinearCase::kRows * c.x[r] * c.x[r];
  const double weight = 120 / static_cast<double>(c.model.size());
  EXPECT_NEAR(fit.sd[0], LinearCase::kFloor / std::sqrt(weight * sum), 1e-3 * fit.sd[0]);
  EXPECT_EQ(FittedEffect(fit, 0).sd[0], fit.sd[0]);
  EXPECT_NEAR(fit.size_sd[0], fit.sd[0], 1e-9 * fit.sd[0]);  // a gain has no shape to hold
}

// Every delay between two switching periods acts alike: its sd is that of an even spread over one.
TEST(Fit, ADelayIsKnownToASwitchingPeriodAtBest) {
  const LinearCase c = CaseOf(1.07, 0);
  EffectInstance delay = MakeInstance(EffectNamed("loop-delay"), "rig");
  delay.Set("time", 1e-4);
  FitOptions options;
  options.effective_sample_size = 300;
  const FitResult fit = Fit(c.model, c.With({LinearCase::Gain(1.02), delay}), options);
  ASSERT_EQ(fit.sd.size(), 2u);
  EXPECT_NEAR(fit.sd[1], 1 / c.data.rig.amplifier.switching_frequency / std::sqrt(12.0), 1e-12);
}

// Data that lie beyond a bound leave the parameter there, with a warning and the error that
// remains.
TEST(Fit, StaysInsideBoundsAndSaysSo) {
  const LinearCase c = CaseOf(1.07, 0);
  Hypothesis start = c.With({LinearCase::Gain(1.02)});
  start.free[0].hi = 1.04;
  FitOptions options;
  options.effective_sample_size = 300;
  const FitResult fit = Fit(c.model, start, options);
  EXPECT_NEAR(fit.hypothesis.free[0].value, 1.04, 1e-9);
  double square = 0;  // rms of (1.07 - 1.04) x over A.x and the A.y that agree
  for (std::size_t r = 0; r < c.fit_records(); ++r) square += std::pow(0.03 * c.x[r], 2);
  EXPECT_NEAR(fit.ratio_fit, std::sqrt(square / 6) / LinearCase::kFloor, 1e-6);
  EXPECT_THAT(fit.warnings, ::testing::Contains(::testing::HasSubstr("is at its bound 1.04")));
}

// Beside a gain that is held at its bound the offset takes what is left: 0.03 times the mean
// position more than its own.
TEST(Fit, FindsTheOthersBesideOneThatIsAtItsBound) {
  const LinearCase c = CaseOf(1.07, 3e-6);
  Hypothesis start = c.With({LinearCase::Gain(1.02), LinearCase::Offset(1e-6)});
  start.free[0].hi = 1.04;
  FitOptions options;
  options.effective_sample_size = 300;
  const FitResult fit = Fit(c.model, start, options);
  EXPECT_NEAR(FittedEffect(fit, 0).Value("gain"), 1.04, 1e-9);
  EXPECT_NEAR(FittedEffect(fit, 1).Value("offset"), 3e-6 + 0.03 * 4e-5, 2e-8);
}

// Records at one position cannot tell a gain from an offset.
TEST(Fit, NamesWhatTheRecordsCannotTellApart) {
  const LinearCase c{{4e-5, 4e-5, 4e-5}, 1.05, 0};
  FitOptions options;
  options.effective_sample_size = 300;
  const FitResult fit =
      Fit(c.model, c.With({LinearCase::Gain(1.01), LinearCase::Offset(1e-6)}), options);
  EXPECT_THAT(fit.warnings, ::testing::Contains(::testing::HasSubstr("are correlated by -1.000")));
  EXPECT_EQ(std::ranges::count_if(
                fit.warnings,
                [](const std::string& w) { return w.find("correlated") != std::string::npos; }),
            1);  // of a pair, not of each of its two
  EXPECT_LT(fit.ratio_fit, 0.1);
}

TEST(Fit, NamesAParameterWithoutInfluence) {
  const LinearCase c{{0, 0, 0}, 1, 5e-6};  // a gain of nothing
  FitOptions options;
  options.effective_sample_size = 300;
  const FitResult fit = Fit(c.model, c.With({LinearCase::Gain(1.05)}), options);
  EXPECT_THAT(fit.warnings, ::testing::Contains(::testing::HasSubstr("has no influence")));
  EXPECT_EQ(fit.sd[0], 0);
  EXPECT_NEAR(fit.hypothesis.free[0].value, 1.05, 1e-6);
}

// Rows that are worth a quarter of a number each tell a size half as well.
TEST(Fit, TheSdFollowsWhatARowIsWorth) {
  LinearCase c{{1e-5, 3e-5, 5e-5}, 1.02, 0};
  FitOptions options;
  options.effective_sample_size = static_cast<double>(c.model.size());
  const auto sd = [&](double independent) {
    for (Target& t : c.model.targets()) t.independent = independent;
    return Fit(c.model, c.With({LinearCase::Gain(1.02)}), options).sd[0];
  };
  const double every = sd(1);
  EXPECT_GT(every, 0);
  EXPECT_NEAR(sd(0), every, 1e-9 * every);  // not known: as many as the case has in all
  EXPECT_NEAR(sd(0.25), 2 * every, 1e-3 * every);
}

// Nothing to fit: the figures of the start, 5 µm over the floor in half of the rows.
TEST(Fit, WithoutFreeParametersItIsAnEvaluation) {
  const LinearCase c{{1e-5, 3e-5}, 1, 5e-6};
  const FitResult fit = Fit(c.model, c.With({}), {});
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.ratio_fit, 5 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(fit.ratio_validate, 5 / std::sqrt(2.0), 1e-9);
}

// Without a record that validates, the fitted ones have to do.
TEST(Fit, WithoutUnseenRecordsTheRatioIsThatOfTheFittedOnes) {
  Case c = LinearCase::Make({std::begin(kFitX), std::end(kFitX)}, 1.08, 0);
  for (CaseRecord& r : c.records) r.validate = false;
  CaseModel model(c);
  for (Target& t : model.targets()) t.floor = LinearCase::kFloor;
  const FitResult result = Fit(model, Hypothesis::Base(c.rig), {});
  EXPECT_GT(result.ratio_fit, 0.5);
  EXPECT_EQ(result.ratio_validate, result.ratio_fit);
}

}  // namespace
}  // namespace ambrig
