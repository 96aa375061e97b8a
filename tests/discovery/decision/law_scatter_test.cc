// How well a parameter is known when the law is in doubt, against sums over a linear problem.
#include "discovery/decision/law_scatter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/search/candidate_fit.h"
#include "discovery/search/likelihood.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kScatterN = 300;
const std::vector<double> kScatterX = {2e-5, 4e-5, 6e-5, 5e-5};

// DerSimonian and Laird for equal weights w: the sample variance less 1/w.
TEST(VarianceBetween, IsTheSampleVarianceLessTheNoise) {
  const double w = 4;
  const std::vector<BlockValue> blocks = {{1, w}, {3, w}, {8, w}};
  EXPECT_NEAR(VarianceBetween(blocks), (9.0 + 1 + 16) / 2 - 1 / w, 1e-12);
}

TEST(VarianceBetween, IsNothingWhereNoiseExplainsTheSpread) {
  EXPECT_EQ(VarianceBetween({{1, 0.1}, {3, 0.1}, {2, 0.1}}), 0);
  EXPECT_EQ(VarianceBetween({{1, 5}}), 0);
  EXPECT_EQ(VarianceBetween({}), 0);
}

// What a block hardly sees it cannot contradict.
TEST(VarianceBetween, ABlockWithoutInformationHasNoSay) {
  EXPECT_NEAR(VarianceBetween({{1, 4}, {3, 4}, {1e6, 0}}), VarianceBetween({{1, 4}, {3, 4}}),
              1e-12);
}

FitResult FittedGain(const LinearCase& c) {
  return FitOn(c.model, c.Base(), c.With({LinearCase::Gain(1.02)}), kScatterN);
}

TEST(SdUnderDoubt, OfTheRightLawIsThatOfTheFit) {
  const LinearCase c(kScatterX, 1.08, 0);
  const FitResult fit = FittedGain(c);
  ASSERT_EQ(fit.sd.size(), 1u);
  EXPECT_NEAR(SdUnderDoubt(c.model, fit, kScatterN)[0], fit.sd[0], 1e-3 * fit.sd[0]);
}

// The data have an offset, the law is a gain: each record asks for its own, o/x beside what was
// fitted.
TEST(SdUnderDoubt, OfAnotherLawHasTheSpreadOfWhatEachRecordAsksFor) {
  const double o = 7e-6;
  const LinearCase c(kScatterX, 1, o);
  const FitResult fit = FittedGain(c);
  const double gain = FittedEffect(fit, 0).Value("gain");
  const double rows = 2 * static_cast<double>(kScatterX.size()) * LinearCase::kRows,
               by_noise = kScatterN / rows;
  std::vector<BlockValue> blocks;
  for (const double x : kScatterX)  // thirds of a record: 16, 17, 17 rows of A.x
    for (const double count : {16.0, 17.0, 17.0})
      blocks.push_back({1 + o / x - gain, by_noise * count * std::pow(x / LinearCase::kFloor, 2)});
  const double sd = SdUnderDoubt(c.model, fit, kScatterN)[0];
  const double weight = MisfitWeight(fit.ratio_fit, kScatterN) / rows;
  double square = 0, information = 0;
  for (std::size_t r = 0; r + 1 < kScatterX.size(); ++r)
    for (const double count : {16.0, 17.0, 17.0}) {
      const double seen = count * std::pow(kScatterX[r] / LinearCase::kFloor, 2);
      information += weight * seen;
      square += std::pow(weight * seen * (1 + o / kScatterX[r] - gain), 2);
    }
  const double sandwich = square / (information * information);
  const double of_law = VarianceBetween(blocks);
  const double of_few =  // what the error of the law leaves of 30 independent numbers
      fit.sd[0] * fit.sd[0] * weight * rows / MisfitWeight(fit.ratio_fit, kScatterN, 30);
  const double expected = std::sqrt(std::max(of_few, sandwich) + of_law);
  EXPECT_NEAR(sd, expected, 0.02 * expected);
  EXPECT_GT(sd, 2 * fit.sd[0]);
}

// Where the parts of the records agree on a wrong value their spread says nothing: the error that
// the law leaves does.
TEST(SdUnderDoubt, OfALawThatLeavesMuchIsThatOfFewNumbers) {
  const LinearCase c(kScatterX, 1.08, 0);
  FitResult fit = FittedGain(c);
  constexpr double kMany = 1e4;
  fit.ratio_fit = 1;
  // at the noise: that of the fit, and what noise of so many numbers does not explain of the
  // blocks' spread
  const double between = std::pow(SdUnderDoubt(c.model, fit, kMany)[0], 2) - std::pow(fit.sd[0], 2);
  EXPECT_GE(between, 0);
  fit.ratio_fit = 1.3;
  const double of_few =
                   fit.sd[0] * std::sqrt(MisfitWeight(1.3, kMany) / MisfitWeight(1.3, kMany, 30)),
               expected = std::sqrt(of_few * of_few + between);
  EXPECT_GT(of_few, 3 * fit.sd[0]);
  EXPECT_NEAR(SdUnderDoubt(c.model, fit, kMany)[0], expected, 0.02 * expected);
}

// What the drawing says is known from elsewhere and holds whatever the law.
TEST(SdUnderDoubt, IsNotMoreThanTheDrawingSays) {
  const LinearCase c(kScatterX, 1, 7e-6);
  FitResult fit = FittedGain(c);
  const double open = SdUnderDoubt(c.model, fit, kScatterN)[0];
  fit.hypothesis.free[0].sd = open / 4;
  EXPECT_LE(SdUnderDoubt(c.model, fit, kScatterN)[0], open / 4);
}

// A parameter whose sd the fit does not tell, at a limit for example, gets none here.
TEST(SdUnderDoubt, WhatHasNoSdGetsNone) {
  const LinearCase c(kScatterX, 1, 7e-6);
  FitResult fit = FittedGain(c);
  fit.sd[0] = 0;
  EXPECT_EQ(SdUnderDoubt(c.model, fit, kScatterN)[0], 0);
}

TEST(SdUnderDoubt, WithoutSensitivitiesNothingChanges) {
  const LinearCase c(kScatterX, 1, 7e-6);
  FitResult fit = FittedGain(c);
  fit.jacobian.resize(0, 0);
  EXPECT_EQ(SdUnderDoubt(c.model, fit, kScatterN), fit.sd);
}

}  // namespace
}  // namespace ambrig
