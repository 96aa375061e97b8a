// Parameters of the rig under their prior, in a problem that is linear in one of them: where data
// and drawing meet has a closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "discovery/search/fit.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

constexpr double kHeldAt = 4e-5, kSd = 1e-3;  // [m] of a held shaft, tilted; of the sensor's z

/// Four records of a shaft held at +x in A and -x in B, the last one unseen: the reading of A.x is
/// x (1 - 2 (z_s - z_A)/(z_B - z_A)), linear in the sensor's z_s, which in truth stands `shift` sd
/// off.
class TiltedCase {
 public:
  explicit TiltedCase(double shift) : data(Make(shift)), model(data) {
    for (Target& t : model.targets()) t.floor = kFloor;
  }

  /// Readings in units of the floor per sd of the place.
  static double Slope() { return 2 * kHeldAt * kSd / (kZB - kZA) / kFloor; }
  /// Effective numbers for which the data weigh `information` over the prior's 1.
  static double SampleSize(double information) {
    // three of four records, one of two channels
    return information / (Slope() * Slope()) * (4.0 * 2) / 3;
  }

  static constexpr double kFloor = 4e-6;  // [m] far above the misfit: every number counts fully
  static constexpr double kZA = -0.12, kZB = 0.13;

  const Case data;
  CaseModel model;

 private:
  static Case Make(double shift) {
    Case c = LinearCase::Make({kHeldAt, kHeldAt, kHeldAt, kHeldAt}, 1, 0);
    c.rig.tolerances = {{"bearings.A.sensor.z", kSd, kRequired}};
    const double z = c.rig.bearings[0].sensor.z + shift * kSd;
    const double reading = kHeldAt * (1 - 2 * (z - kZA) / (kZB - kZA));
    for (CaseRecord& r : c.records) {
      r.scenario.clamp["B"] = {-kHeldAt, 0};
      for (double& v : r.data.channels[0].samples) v = reading;
    }
    return c;
  }
};

/// Shift of the fit in sd, where the data's own is `shift` and their information `information`.
FitResult Fitted(double shift, double information) {
  const TiltedCase c(shift);
  FitOptions options;
  options.effective_sample_size = TiltedCase::SampleSize(information);
  options.tolerance = 1e-9;
  options.iterations = 30;
  return Fit(c.model, Hypothesis::Base(c.data.rig), options);
}

double ShiftOf(const FitResult& fit) {
  return (fit.hypothesis.free[0].value - fit.hypothesis.free[0].start) / kSd;
}

// Within three sd both are Gaussian: u = G u*/(G + 1), known to 1/√(G + 1).
TEST(FitPrior, WithinTheToleranceDataAndDrawingShareByTheirInformation) {
  for (const double G : {1.0, 4.0})
    for (const double wanted : {-2.0, 1.5}) {
      const FitResult fit = Fitted(wanted, G);
      ASSERT_EQ(fit.hypothesis.free.size(), 1u);
      EXPECT_NEAR(ShiftOf(fit), wanted * G / (G + 1), 2e-3);
      EXPECT_NEAR(fit.sd[0], kSd / std::sqrt(G + 1), 0.01 * kSd);
      EXPECT_NEAR(fit.penalty, std::pow(ShiftOf(fit), 2), 1e-6);
    }
}

// Beyond three sd each further one counts as five: the least of G (u - u*)² + (5 u - 12)².
TEST(FitPrior, FarOffTheDrawingEveryFurtherStepCostsFiveTimes) {
  const double G = 4;
  for (const double wanted : {10.0, -12.0}) {
    const double u = (G * std::abs(wanted) + 60) / (G + 25);
    ASSERT_GT(u, 3);
    const FitResult fit = Fitted(wanted, G);
    EXPECT_NEAR(ShiftOf(fit), std::copysign(u, wanted), 0.02);
    EXPECT_LT(std::abs(ShiftOf(fit)), std::abs(wanted) * G / (G + 1));  // of a plain Gaussian
  }
}

// Between both it stays at three: data that ask for five are not strong enough to go on.
TEST(FitPrior, AtThreeStandardDeviationsItHolds) { EXPECT_NEAR(ShiftOf(Fitted(5, 4)), 3, 0.05); }

}  // namespace
}  // namespace ambrig
