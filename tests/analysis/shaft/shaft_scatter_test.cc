// Rotors that scatter, against closed forms of a rigid rotor on springs.
#include "analysis/shaft/shaft_scatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/math/constants.h"
#include "tests/analysis/shaft/jeffcott_shaft.h"

namespace ambrig {
namespace {

/// The stiffness of both supports, in both planes or in x alone.
ShaftParameter SpringIn(double k, bool both) {
  ShaftParameter p{"rotor.support[0].k", "N/m", k, 0, 1e12, {}};
  p.set.push_back([both](BeamFile& to, double v) {
    for (SpringSupport& s : to.definition.supports) {
      s.kxx = v;
      if (both) s.kyy = v;
    }
  });
  return p;
}

// Rigid rotor on springs k with sd: f follows sqrt(k); 5 and 95 % quantiles at ∓1.645 sd.
TEST(ShaftScatter, QuantilesOfASpring) {
  BeamFile file = testing::JeffcottShaft(1e6, 50);
  file.parameters = {SpringIn(5e5, true)};
  const std::vector<Tolerance> sd = {{"rotor.support[0].k", 2.5e4, kRequired}};
  const int n = 2000;
  ScatterPlan plan;
  plan.modes = 2;
  plan.rotors = n;
  plan.seed = 7;
  const ShaftScatter s = ScatterShaft(file, sd, plan);
  const double f = std::sqrt(1e6 / Totals(BuildBeam(file.definition)).mass) / (2 * kPi);
  // a quantile of n draws errs by sqrt(p (1 - p)/n)/density: 0.047 sd at 5 %, five of them allowed
  const double band = f * 0.5 * 0.05, error = 5 * 0.047 * band;
  ASSERT_GE(s.modes.size(), 1U);
  EXPECT_NEAR(s.modes[0].frequency.low, f * std::sqrt(1 - 1.645 * 0.05), error);
  EXPECT_NEAR(s.modes[0].frequency.high, f * std::sqrt(1 + 1.645 * 0.05), error);
  EXPECT_NEAR(s.modes[0].frequency.middle, f, error);
  const ShaftScatter again = ScatterShaft(file, sd, plan);
  EXPECT_EQ(again.modes[0].frequency.high, s.modes[0].frequency.high);
}

// The same spring under an unbalance u at the disk: below all its resonances |x| = u w²/|k - m
// w² + i c w| falls with k, so that the quantiles of the response are the responses of the
// quantiles; critical speeds follow sqrt(k).
TEST(ShaftScatter, QuantilesOfResponseAndCriticalSpeed) {
  const double k = 1e6, c = 50, sd = 0.05, u = 1e-5;
  BeamFile file = testing::JeffcottShaft(k, c);
  file.parameters = {SpringIn(k / 2, true)};
  const BeamRotor beam = BuildBeam(file.definition);
  const double m = Totals(beam).mass, natural = std::sqrt(k / m);
  ScatterPlan plan;
  plan.speed = natural;
  plan.modes = 4;
  plan.rotors = 2000;
  plan.unbalance = {{"middle", {{0.6, u, 0}}}};
  plan.probes = {{"disk", 0.6, ""}};
  plan.speeds = {0.5 * natural, 0.7 * natural};
  std::vector<double> grid;
  for (int n = 1; n <= 20; ++n) grid.push_back(0.1 * n * natural);
  for (const DampedCritical& at :
       FollowShaft(beam, ShapesOfBeam(beam, natural, 4), grid, 4).criticals)
    if (std::abs(at.speed / natural - 1) < 0.01) plan.criticals.push_back(at);
  ASSERT_FALSE(plan.criticals.empty());
  const ShaftScatter s = ScatterShaft(file, {{"rotor.support[0].k", sd * k / 2, kRequired}}, plan);
  // 5 %: five times the error of a quantile of 2000 draws, 0.047 sd, as above
  const double quantile[] = {k * (1 - 1.645 * sd), k, k * (1 + 1.645 * sd)};
  const double error = 5 * 0.047 * 1.645 * sd;
  ASSERT_EQ(s.responses.size(), 1U);
  for (std::size_t n = 0; n < 2; ++n) {
    const double w = plan.speeds[n];
    const auto amplitude = [&](double stiffness) {
      return u * w * w / std::hypot(stiffness - m * w * w, c * w);
    };
    const ScatterBand& band = s.responses[0].amplitude[n];
    const double slope = k / (k - m * w * w);  // of ln |x| over ln k
    EXPECT_NEAR(s.responses[0].nominal[n] / amplitude(k), 1, 1e-3);
    EXPECT_NEAR(band.low / amplitude(quantile[2]), 1, 2 * slope * error);
    EXPECT_NEAR(band.middle / amplitude(quantile[1]), 1, 2 * slope * error);
    EXPECT_NEAR(band.high / amplitude(quantile[0]), 1, 2 * slope * error);
    EXPECT_LT(band.low, 0.95 * band.high);
  }
  for (const ScatteredCritical& at : s.criticals) {
    EXPECT_EQ(at.found, plan.rotors);
    EXPECT_NEAR(at.speed.low / std::sqrt(quantile[0] / m), 1, error);
    EXPECT_NEAR(at.speed.high / std::sqrt(quantile[2] / m), 1, error);
  }
}

// Only x scatters: of each pair of one pole the lower one is x below the file's stiffness and y
// above it.
TEST(ShaftScatter, PairsOfOnePoleComeApart) {
  const double k = 1e6, sd = 0.05;
  BeamFile file = testing::JeffcottShaft(k, 50);
  file.parameters = {SpringIn(k / 2, false)};
  const BeamRotor beam = BuildBeam(file.definition);
  const double natural = std::sqrt(k / Totals(beam).mass);
  ScatterPlan plan;
  plan.speed = natural;
  plan.modes = 2;
  plan.rotors = 2000;
  for (const DampedCritical& at :
       FollowShaft(beam, ShapesOfBeam(beam, natural, 4), {0.5 * natural, 1.5 * natural}, 4)
           .criticals)
    if (std::abs(at.speed / natural - 1) < 0.01) plan.criticals.push_back(at);
  ASSERT_EQ(plan.criticals.size(), 2U);
  const ShaftScatter s = ScatterShaft(file, {{"rotor.support[0].k", sd * k / 2, kRequired}}, plan);
  const double low = std::sqrt(1 - 1.645 * sd), high = std::sqrt(1 + 1.645 * sd),
               error = 5 * 0.047 * 1.645 * sd;  // of a quantile of 2000 draws, as above
  const double f = natural / (2 * kPi);
  for (const auto& [lower, upper, nominal] :
       {std::tuple{s.modes[0].frequency, s.modes[1].frequency, f},
        {s.criticals[0].speed, s.criticals[1].speed, natural}}) {
    EXPECT_NEAR(lower.low / nominal, low, error);
    EXPECT_NEAR(lower.high / nominal, 1, 1e-4);
    EXPECT_NEAR(upper.low / nominal, 1, 1e-4);
    EXPECT_NEAR(upper.high / nominal, high, error);
  }
  EXPECT_EQ(s.criticals[0].found, plan.rotors);
}

}  // namespace
}  // namespace ambrig
