// The weight of an error and its price: derivative, floor and limits in closed form.
#include "discovery/search/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

TEST(Likelihood, WeightIsTheSlopeOfTheMisfit) {
  for (const double n : {50.0, 2e4, 2e5})
    for (const double ratio : {1.001, 1.1, 2.0, 15.0}) {
      const double h = 1e-6 * ratio * ratio;
      const double up = Misfit(std::sqrt(ratio * ratio + h), n),
                   down = Misfit(std::sqrt(ratio * ratio - h), n);
      EXPECT_NEAR((up - down) / (2 * h), MisfitWeight(ratio, n), 1e-4 * MisfitWeight(ratio, n))
          << ratio << " " << n;
    }
}

TEST(Likelihood, AtTheFloorEveryNumberCounts) {
  EXPECT_EQ(Misfit(1, 1e5), 0);
  EXPECT_EQ(MisfitWeight(1, 1e5), 1e5);
  EXPECT_NEAR(Misfit(std::sqrt(1 + 1e-6), 1e5), 0.1, 1e-4);  // n (R² - 1)
  EXPECT_NEAR(Misfit(std::sqrt(1 - 1e-3), 1e5), -100, 1e-9);
}

// Far above the floor the price of halving the excess no longer depends on how many rows there are.
TEST(Likelihood, FarAboveTheFloorOnlyThreeHundredNumbersCount) {
  const auto halving = [](double n) {
    return Misfit(std::sqrt(1 + 100.0), n) - Misfit(std::sqrt(1 + 50.0), n);
  };
  EXPECT_NEAR(halving(1e6), 300 * std::log(2.0), 0.1);
  EXPECT_NEAR(halving(1e4), halving(1e6), 1);
}

/// Three fit records and one unseen one of A.x and A.y.
LinearCase Quarter() { return {{2e-5, 4e-5, 6e-5, 5e-5}, 1, 0}; }

// Both kinds of record weigh by their rows: three quarters and one quarter here.
TEST(Score, IsTheMisfitOfAllRecordsAndThePriceOfEveryNumber) {
  const LinearCase c = Quarter();
  const double n = 200;
  EXPECT_NEAR(Score(c.model, 1, 1, n, 0, 0), 0, 1e-12);
  EXPECT_NEAR(Score(c.model, 1.3, 1, n, 0, 0), 0.75 * Misfit(1.3, n), 1e-9);
  EXPECT_NEAR(Score(c.model, 1, 1.3, n, 0, 0), 0.25 * Misfit(1.3, n), 1e-9);
  EXPECT_NEAR(Score(c.model, 0.5, 0.9, n, 0, 0), 0,
              1e-12);  // below the noise is not better than it
  EXPECT_NEAR(Score(c.model, 1, 1, n, 3, 1.5), 1.5 + 3 * std::log(200.0), 1e-9);
  // No number costs more than ln 300, however many rows there are, nor counts the floor beyond 1 %.
  EXPECT_NEAR(Score(c.model, 1, 1, 1e6, 2, 0), 2 * std::log(300.0), 1e-9);
  EXPECT_NEAR(Score(c.model, 1.01, 1.01, 1e6, 0, 0), Misfit(1.01, 1e4), 1e-9);
}

// A kind of effect costs 4 once, its numbers ln n each, six of one effect at most; the rig's own
// are priced by their prior.
TEST(Score, AnEffectCostsItsLawOnceAndItsNumbersEach) {
  const LinearCase c = Quarter();
  FitResult fit;
  fit.ratio_fit = fit.ratio_validate = 1;
  fit.penalty = 0.7;
  fit.hypothesis = c.With({});
  const double number = std::log(300.0);
  EXPECT_NEAR(Score(c.model, fit, 1e5), 0.7, 1e-12);
  fit.hypothesis = c.With({LinearCase::Gain(1.1)});
  EXPECT_NEAR(Score(c.model, fit, 1e5), 0.7 + number + 4, 1e-9);
  EffectInstance other = LinearCase::Gain(1.1);
  other.target = "A.y";
  fit.hypothesis = c.With({LinearCase::Gain(1.1), other});
  EXPECT_NEAR(Score(c.model, fit, 1e5), 0.7 + 2 * number + 4, 1e-9);
  fit.hypothesis = c.With({LinearCase::Gain(1.1), LinearCase::Offset(1e-6)});
  EXPECT_NEAR(Score(c.model, fit, 1e5), 0.7 + 2 * number + 8, 1e-9);
  EXPECT_EQ(PricedParameters(2), 2);
  EXPECT_EQ(PricedParameters(6), 6);
  EXPECT_EQ(PricedParameters(11), 6);
}

// At the floor the scores alone tell two laws apart.
TEST(Probabilities, OfAnExactLawAreThoseOfTheLikelihood) {
  const std::vector<double> p = Probabilities({10, 12, 30}, {1.0, 0.99, 0.5}, {0, 0, 0});
  const double sum = 1 + std::exp(-1.0) + std::exp(-10.0);
  EXPECT_NEAR(p[0], 1 / sum, 1e-12);
  EXPECT_NEAR(p[1], std::exp(-1.0) / sum, 1e-12);
  EXPECT_NEAR(p[2], std::exp(-10.0) / sum, 1e-12);
}

// The best leaves 40 %: a law that explains 10 % less than it is not excluded by any score.
TEST(Probabilities, LawsOfWhichNoneFitsAreNotToldApart) {
  const std::vector<double> p = Probabilities({100, 300}, {0.6, 0.5}, {0, 0});
  const double other = std::exp(-0.5 * std::pow(0.1 / (0.35 * 0.4), 2));
  EXPECT_NEAR(p[1], other / (1 + other), 1e-12);
  // the same difference beside a law that explains 98 %
  EXPECT_LT(Probabilities({100, 300}, {0.98, 0.88}, {0, 0})[1], 1e-20);
}

TEST(Probabilities, RoomOfALawCountsAgainstItWhereSharesDecide) {
  const double other = std::exp(-0.5 * (std::pow(0.1 / (0.35 * 0.4), 2) + 2 * 4));
  EXPECT_NEAR(Probabilities({100, 300}, {0.6, 0.5}, {0, 2})[1], other / (1 + other), 1e-12);
  // the best is not made better by having more
  EXPECT_EQ(Probabilities({100, 300}, {0.6, 0.5}, {2, 0}),
            Probabilities({100, 300}, {0.6, 0.5}, {0, 0}));
}

}  // namespace
}  // namespace ambrig
