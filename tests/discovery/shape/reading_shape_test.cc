// The gain of a position sensor in a free shape: what stands in the rig file is the curve of the
// report, and sensors of other laws than a constant gain are found. Their plants are formulas that
// this shape cannot make exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.h"
#include "discovery/practice/laws/practice_law.h"
#include "discovery/shape/named_law.h"
#include "discovery/shape/shape_fit.h"
#include "tests/discovery/shape/pushed_rotor.h"

namespace ambrig {
namespace {

EffectInstance GainAt(const std::string& axis, double gain) {
  EffectInstance e = MakeInstance(EffectNamed("sensor-gain"), axis);
  e.Set("gain", gain);
  return e;
}

/// What the sensor of bearing A shows of (x, y) with an effect in the rig file.
PlanePoint ReadingOf(const EffectInstance& e, double x, double y) {
  RigParameters rig = ReferenceRig();
  rig.effects = {e};
  const Plant plant = BuildPlant(TrueRig(rig));
  for (const auto& map : plant.bearings[0].sensor.maps) map->Map(MotionState{}, &x, &y);
  return {x, y};
}

TEST(ReadingShape, FormulaSaysWhatTheCurveSays) {
  Shape s = ShapeOf(GainAt("A.y", 1.1), ReferenceRig(), {.radius = 6e-5});
  for (const double u : {-8e-5, 0.0, 3e-5}) EXPECT_NEAR(s.value(s.Sizes(), u), 0.1 * u, 1e-18);
  for (std::size_t k = 0; k < s.rows.size(); ++k)
    s.effect.values[s.rows[k]] = 0.9 + 0.05 * static_cast<double>(k);
  for (const double u : {-9e-5, -5e-5, -3e-5, -1e-5, 0.0, 1e-5, 3e-5, 5e-5, 9e-5}) {
    const PlanePoint p = ReadingOf(s.effect, 7e-6, u);
    EXPECT_NEAR(p.x, 7e-6, 1e-18);
    EXPECT_NEAR(p.y, u + s.value(s.Sizes(), u), 1e-14) << u;
  }
}

TEST(ReadingShape, RefusesWhatHasNoCurve) {
  EXPECT_THROW(ShapeOf(GainAt("A.x", 1.1), ReferenceRig(), {}), InputError);
  EXPECT_THROW(ShapeOf(GainAt("Z", 1.1), ReferenceRig(), {.radius = 6e-5}), InputError);
}

/// Error over the noise that the fitted constant gain leaves and that its free shape leaves; the
/// shape's curve where the records drive it.
struct FoundReading {
  double law = 0, refined = 0;
  Shape shape;
  ShapeFit fit;
};
FoundReading FindReading(const std::string& reading) {
  const PushedRotor rotor(FormulaAt("A", {{"reading.x", reading}}));
  const Hypothesis base = Hypothesis::Base(rotor.data.rig);
  Hypothesis with = base;
  with.AddEffect(GainAt("A.x", 1.04));
  FitOptions options;
  options.effective_sample_size = kMotionN;
  const FitResult law = Fit(*rotor.model, with, options);
  const EffectInstance fitted = law.hypothesis.rig.effects.back();
  FoundReading out{
      law.ratio_fit, 0, ShapeOf(fitted, base.rig, ReachOf(*rotor.model, base, fitted)), {}};
  ShapeFitOptions shape_options;
  shape_options.effective_sample_size = kMotionN;
  out.fit = FitShape(*rotor.model, base, out.shape, shape_options);
  out.refined = out.fit.fit.ratio_fit;
  return out;
}

TEST(ReadingShape, FindsTheGainsOfTwoSides) {
  const FoundReading f = FindReading("x > 0 ? 1.12 * x : 1.02 * x");
  EXPECT_GT(f.law, 1.2);
  EXPECT_LT(f.refined, 1.05);
  for (const double u : {-0.8, -0.4, 0.4, 0.8}) {
    const double at = u * f.shape.u.back(), sd = f.fit.CurveSd(f.shape, at);
    EXPECT_NEAR(f.shape.value(f.fit.sizes, at), (u > 0 ? 0.12 : 0.02) * at,
                4 * sd + 0.005 * std::abs(at))
        << u;
  }
}

TEST(ReadingShape, FindsAGainThatBends) {
  const FoundReading f = FindReading("1.05 * x + 1e3 * x ^ 2");
  EXPECT_GT(f.law, 1.2);
  EXPECT_LT(f.refined, 1.1);
  for (const double u : {-0.6, 0.6}) {
    const double at = u * f.shape.u.back(), sd = f.fit.CurveSd(f.shape, at);
    EXPECT_NEAR(f.shape.value(f.fit.sizes, at), 0.05 * at + 1e3 * at * at,
                4 * sd + 0.01 * std::abs(at))
        << u;
  }
}

}  // namespace
}  // namespace ambrig
