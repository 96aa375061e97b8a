// Calibrated probabilities: softmax by hand, fits that have to find known shares, sets.
#include "discovery/calibration/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ambrig {
namespace {

StatedAnswer TwoNames(double first, double second, double unknown) {
  StatedAnswer a;
  a.members = {{"saturation", "A", first},
               {"iron-reluctance", "A", second},
               {"unknown", "", unknown},
               {"quiet", "", 0},
               {"data", "", 0}};
  return a;
}

CalibrationCase Judged(const StatedAnswer& a, std::size_t right) {
  CalibrationCase c = {a, std::vector<char>(a.members.size(), 0)};
  if (right < c.right.size()) c.right[right] = 1;
  return c;
}

// As computed: 0.7, 0.2, 0.1 and 0.002 each for what had nothing, over their sum 1.004.
TEST(CalibrationOfNames, AsComputedUpToTheLeast) {
  const std::vector<double> p =
      CalibratedProbabilities(CalibrationTable().weights, TwoNames(0.7, 0.2, 0.1));
  EXPECT_NEAR(p[0], 0.7 / 1.004, 1e-12);
  EXPECT_NEAR(p[2], 0.1 / 1.004, 1e-12);
  EXPECT_NEAR(p[3], 0.002 / 1.004, 1e-12);
  EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1, 1e-12);
}

// a = 1/2 takes the root: sqrt(0.64) : sqrt(0.16) : sqrt(0.04) = 0.8 : 0.4 : 0.2.
TEST(CalibrationOfNames, TheExponentFlattens) {
  CalibrationWeights w{0.5};
  const std::vector<double> p = CalibratedProbabilities(w, TwoNames(0.64, 0.16, 0.04));
  EXPECT_NEAR(p[0] / p[1], 2, 1e-12);
  EXPECT_NEAR(p[1] / p[2], 2, 1e-12);
}

// 0.9 was stated 300 times and right 180 times, the other name 60 times, "unknown" 60 times.
TEST(CalibrationOfNames, OverconfidenceIsFound) {
  std::vector<CalibrationCase> cases;
  for (int k = 0; k < 300; ++k)
    cases.push_back(Judged(TwoNames(0.9, 0.06, 0.04), k % 5 < 3 ? 0 : k % 5 == 3 ? 1 : 2));
  const CalibrationWeights w = FitCalibration(cases);
  const std::vector<double> p = CalibratedProbabilities(w, cases[0].answer);
  // the prior and what quiet and data keep take a little
  EXPECT_NEAR(p[0], 0.6, 0.03);
  EXPECT_NEAR(p[1], 0.2, 0.03);
  EXPECT_NEAR(p[2], 0.2, 0.03);
}

// The fit is the least of |w - "as computed"|²/(2 2²) - Σ ln p(right): no small step from there
// makes it less.
TEST(CalibrationOfNames, TheFitIsTheMostProbable) {
  std::vector<CalibrationCase> cases;
  for (int k = 0; k < 7; ++k) {
    cases.push_back(Judged(TwoNames(0.7, 0.2, 0.1), k % 3 == 0 ? 2 : 0));
    cases.back().answer.features = {0.1 * k, 0.5, 0, 0.3, k % 2 ? 1.0 : 0.0};
  }
  const auto cost = [&](const CalibrationWeights& w) {
    double sum = 0;
    for (std::size_t k = 0; k < w.size(); ++k) sum += std::pow(w[k] - (k == 0 ? 1 : 0), 2) / 8;
    for (const CalibrationCase& c : cases) {
      const std::vector<double> p = CalibratedProbabilities(w, c.answer);
      for (std::size_t k = 0; k < p.size(); ++k)
        if (c.right[k]) sum -= std::log(p[k]);
    }
    return sum;
  };
  const CalibrationWeights w = FitCalibration(cases);
  const double least = cost(w);
  EXPECT_LT(least, cost(CalibrationTable().weights));
  for (std::size_t k = 0; k < w.size(); ++k)
    for (const double step : {-1e-3, 1e-3}) {
      CalibrationWeights other = w;
      other[k] += step;
      EXPECT_GT(cost(other), least) << k;
    }
  // Without cases nothing is known better than as it was computed.
  const CalibrationWeights none = FitCalibration({});
  for (std::size_t k = 0; k < none.size(); ++k) EXPECT_NEAR(none[k], k == 0 ? 1 : 0, 1e-9) << k;
}

// The same statement, but a feature tells when "unknown" is right.
TEST(CalibrationOfNames, FeaturesTellUnknown) {
  std::vector<CalibrationCase> cases;
  for (int k = 0; k < 200; ++k) {
    StatedAnswer a = TwoNames(0.8, 0.1, 0.1);
    a.features[0] = k % 2;  // share left unexplained
    cases.push_back(Judged(a, k % 2 ? 2 : 0));
  }
  const CalibrationWeights w = FitCalibration(cases);
  EXPECT_LT(CalibratedProbabilities(w, cases[0].answer)[2], 0.1);
  EXPECT_GT(CalibratedProbabilities(w, cases[1].answer)[2], 0.9);
}

TEST(CalibrationOfNames, NoRightMemberTeachesUnknown) {
  const StatedAnswer a = TwoNames(0.9, 0.05, 0.05);
  const CalibrationWeights w = FitCalibration(std::vector(50, Judged(a, 99)));
  EXPECT_GT(CalibratedProbabilities(w, a)[2], 0.8);
}

TEST(CalibrationOfNames, SetHoldsWhatReachesTheLeast) {
  CalibrationTable table;
  table.least = 0.15;
  auto set = CalibratedSet(table, TwoNames(0.2, 0.7, 0.1), "parameters");
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].effect, "iron-reluctance");
  EXPECT_EQ(set[1].effect, "saturation");
  for (const SetMember& m : set) {  // a member at the least itself is in
    table.least = m.probability;
    const auto with = CalibratedSet(table, TwoNames(0.2, 0.7, 0.1), "parameters");
    EXPECT_EQ(with.back().effect, m.effect);
  }
  table.least = 0.9;  // nothing reaches it: the best stays
  set = CalibratedSet(table, TwoNames(0.2, 0.7, 0.1), "parameters");
  ASSERT_EQ(set.size(), 1U);
  table.least = 0;
  set = CalibratedSet(table, TwoNames(0.2, 0.7, 0.1), "none");
  EXPECT_EQ(set.size(), 5U);
  EXPECT_TRUE(
      std::any_of(set.begin(), set.end(), [](const auto& m) { return m.effect == "none"; }));
}

// Of an explanation: what the names leave is "unknown"; a quiet verdict has it instead.
TEST(CalibrationOfNames, MembersOfAnExplanation) {
  Explanation e;
  e.verdict = ExplanationVerdict::kEffect;
  e.ranking.resize(1);
  e.ranking[0].effect.name = "saturation";
  e.ranking[0].effect.target = "B";
  e.ranking[0].probability = 0.97;
  e.set = {{"saturation", "B", 0.97}};
  e.closure.explained = 0.9;
  e.closure.floors_before = 10;
  e.closure.floors_after = 1;
  StatedAnswer a = StatedAnswerOf(e);
  ASSERT_EQ(a.members.size(), 4U);
  EXPECT_NEAR(a.members[1].probability, 0.03, 1e-12);
  EXPECT_NEAR(a.features[0], 0.1, 1e-12);
  EXPECT_NEAR(a.features[3], std::log(10.0), 1e-12);
  e.verdict = ExplanationVerdict::kParameters;
  e.ranking[0].probability = 0;
  a = StatedAnswerOf(e);
  EXPECT_EQ(a.members[1].probability, 0);
  EXPECT_EQ(a.members[2].effect, "quiet");
  EXPECT_NEAR(a.members[2].probability, 1, 1e-12);
}

// explain keeps its own probabilities until enough cases stand behind the table.
TEST(CalibrationOfNames, StoredTableSaysHowManyCases) {
  const CalibrationTable& t = StoredCalibration();
  if (t.cases == 0) {
    EXPECT_EQ(t.weights, CalibrationTable().weights);
  } else {
    EXPECT_GT(t.weights[0], 0) << "a larger p must stay larger";
  }
}

}  // namespace
}  // namespace ambrig
