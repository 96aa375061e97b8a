// A magnetisation curve is found that no single law of the catalogue describes: the iron measured
// follows the steel's curve and a constant path besides, each by code of its own.
#include "discovery/shape/shape_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "discovery/shape/named_law.h"
#include "effects/steel_curve.h"
#include "tests/discovery/shape/held_case.h"

namespace ambrig {
namespace {

constexpr double kHeldKnee = 0.5, kSteel = 0.05, kHeldPath = 1.5e-5;  // [T], [m], [m]

double TrueDrop(double B) {
  double H, slope;
  SteelCurve(B / kHeldKnee, &H, &slope);
  return kSteel * H + kHeldPath * B / kMu0;
}

struct HeldShape : HeldIron {
  HeldShape()
      : HeldIron({IronAtA("saturation", {{"knee", kHeldKnee}, {"path", kSteel}}),
                  IronAtA("iron-reluctance", {{"path", kHeldPath}})}) {}
};

TEST(ShapeFit, FindsACurveOfAnotherForm) {
  const HeldShape held;
  // the largest density, bracketed to 1 %: a kink at it would show, one beyond would not
  const double reach = LargestDensity(*held.model, held.truth, "A");
  EXPECT_GT(reach, 0.3);
  EXPECT_LT(reach, 1.0);
  // a named law that is wrong in both of its numbers
  EffectInstance named = MakeInstance(EffectNamed("saturation"), "A");
  named.Set("knee", 0.55);
  named.Set("path", 0.08);
  const Shape shape = ShapeOf(named, held.data.rig, {.density = reach});
  Hypothesis catalogue = Hypothesis::Base(held.data.rig);
  catalogue.rig.effects.push_back(named);
  const double before =
      Ratio(*held.model, Residual(*held.model, *held.model->Predict(catalogue)), Which::kFit);
  const ShapeFit fit = FitShape(*held.model, Hypothesis::Base(held.data.rig), shape, {2000});
  ASSERT_TRUE(fit.fit.converged);
  EXPECT_GT(before, 2);
  EXPECT_LT(fit.fit.ratio_fit, 1.1);
  const double most = TrueDrop(reach);
  int supported = 0;
  for (const double B : shape.u) {
    if (fit.Support(shape, B) < 0.75) continue;
    ++supported;
    // 4 sd, and what a path linear between nodes loses on the steel's bend
    EXPECT_NEAR(shape.value(fit.sizes, B), TrueDrop(B), 4 * fit.CurveSd(shape, B) + 0.02 * most)
        << B;
  }
  EXPECT_GT(supported, 40);
  for (const double size : fit.sizes) EXPECT_GE(size, 0);
}

// Beyond what the records reach nothing is claimed.
TEST(ShapeFit, ClaimsNothingWhereNoRecordGoes) {
  const HeldShape held;
  const double reach = LargestDensity(*held.model, held.truth, "A");
  EffectInstance named = MakeInstance(EffectNamed("saturation"), "A");
  named.Set("knee", 0.5);
  named.Set("path", 0.06);
  const Shape shape = ShapeOf(named, held.data.rig, {.density = 2 * reach});
  const ShapeFit fit = FitShape(*held.model, Hypothesis::Base(held.data.rig), shape, {2000});
  EXPECT_LT(fit.influence.back(), 1);
  // Records only take away from what the penalty alone leaves, and at the end nearly nothing.
  ASSERT_EQ(fit.prior.rows(), static_cast<Eigen::Index>(fit.sizes.size()));
  for (Eigen::Index k = 0; k < fit.prior.rows(); ++k)
    EXPECT_LE(fit.posterior(k, k), fit.prior(k, k) * (1 + 1e-9)) << k;
  EXPECT_LT(fit.Support(shape, 2 * reach), fit.Support(shape, 0.8 * reach));
  EXPECT_GT(fit.influence[3], 1);
  EXPECT_GT(fit.CurveSd(shape, 2 * reach), 20 * fit.CurveSd(shape, 0.8 * reach));
}

// A curve sin(c0/1e-3 + c1 u): its slopes in the sizes are known, its sd is their sum with the
// posterior's covariance, the support what the records took of the prior's.
TEST(ShapeFit, TheSdOfACurveIsThatOfItsSlopes) {
  Shape shape;
  shape.step = Eigen::Vector2d(1e-3, 0.5);
  shape.value = [](const std::vector<double>& c, double u) {
    return std::sin(c[0] / 1e-3 + c[1] * u);
  };
  ShapeFit fit;
  fit.sizes = {4e-4, 0.3};
  fit.posterior = Eigen::Matrix2d{{1e-8, 2e-6}, {2e-6, 0.01}};
  fit.prior = Eigen::Matrix2d{{4e-8, 0}, {0, 0.09}};
  for (const double u : {0.0, 0.7, 2.0}) {
    const double slope = std::cos(0.4 + 0.3 * u);
    const Eigen::Vector2d g(slope / 1e-3, slope * u);
    const double left = g.dot(fit.posterior * g);
    EXPECT_NEAR(fit.CurveSd(shape, u), std::sqrt(left), 1e-5 * std::sqrt(left)) << u;
    EXPECT_NEAR(fit.Support(shape, u), 1 - left / g.dot(fit.prior * g), 1e-5) << u;
  }
}

}  // namespace
}  // namespace ambrig
