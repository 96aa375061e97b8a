// The laws of free shape that `ambrig refine` writes: tables, relaxations, operators.
#include <gtest/gtest.h>

#include <complex>

#include "effects/coil_targets.h"
#include "effects/law_tables.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

constexpr double kRefinedStep = 1 / 450e3;  // [s] the ADC's

double RefinedDropOf(const FluxLaw& law, double phi, double* slope = nullptr) {
  Lane drop, tangent;
  law.Drop(Currents(phi), &drop, &tangent);
  if (slope) *slope = tangent[3];
  return drop[3];
}

Values EqualPaths(double reach, double path) {
  Values values = {{"reach", reach}};
  for (int k = 0; k < kBhNodes; ++k) values.emplace_back("path" + std::to_string(k), path);
  return values;
}

// A table of equal paths is a longer gap: the flux at rest of the effect iron-reluctance, whose own
// code has no iron law at all. The reach does not matter, the flux may lie beyond it.
TEST(BhCurve, EqualPathsAreALongerGap) {
  Plant reluctance = PlantWith("iron-reluctance", "A", {{"path", 3e-5}});
  const double wanted = RestFlux(reluctance, Currents(3), 2e-5)[0];
  for (const double reach : {0.2, 1.0}) {
    Plant table = PlantWith("bh-curve", "A", EqualPaths(reach, 3e-5));
    EXPECT_NEAR(RestFlux(table, Currents(3), 2e-5)[0], wanted, 1e-9 * std::abs(wanted)) << reach;
  }
}

// path = b/reach * p at the nodes: M = p B²/(2 reach mu0), and its slope.
TEST(BhCurve, DropIsTheIntegralOfItsPaths) {
  Values values = {{"reach", 0.6}};
  for (int k = 0; k < kBhNodes; ++k)
    values.emplace_back("path" + std::to_string(k), 1e-4 * k / (kBhNodes - 1));
  Plant plant = PlantWith("bh-curve", "A", values);
  const double per_flux = DensityPerFlux(plant.bearings[0]);
  for (const double B : {-0.55, -0.1, 0.0, 0.03, 0.31, 0.6}) {
    double slope = 0;
    const double drop = RefinedDropOf(*plant.bearings[0].laws.at(0), B / per_flux, &slope);
    EXPECT_NEAR(drop, std::copysign(1e-4 * B * B / (2 * 0.6 * kMu0), B), 1e-9) << B;
    EXPECT_NEAR(slope, 1e-4 * std::abs(B) / 0.6 / kMu0 * per_flux, 1e-6 * per_flux) << B;
  }
}

// Driven by a sampled sine the law answers with its own transfer function: exact steps for a flux
// linear over a step; the chords of the sine are (w h)²/12 smaller, and relaxations faster than a
// step lag by up to w h/2.
TEST(EddyImpedance, StepsReproduceTheFrequencyResponse) {
  Plant plant = PlantWith("eddy-impedance", "A", {{"path", 1e-5}, {"r4", 0.2}, {"r6", 0.5}});
  FluxLaw& law = *plant.bearings[0].laws.at(0);
  law.SetStep(kRefinedStep);
  law.Settle(Lane{});
  const double gap = GapReluctanceOf(plant.bearings[0]),
               rest = 1e-5 * plant.bearings[0].lanes.reluctance.per_metre, f = 4000;
  const int cycles = 60;
  const double h = kRefinedStep, w = 2 * kPi * f;
  const int steps = static_cast<int>(std::lround(cycles / (f * h)));
  Complex seen = 0;
  double counted = 0;
  for (int k = 1; k <= steps; ++k) {
    const double phi = 1e-5 * std::sin(w * k * h), drop = RefinedDropOf(law, phi);
    law.Commit(Currents(phi));
    if (k <= steps / 2) continue;  // whole cycles: 30 of the 60
    seen += drop * Complex(std::sin(w * k * h), std::cos(w * k * h));
    counted += 0.5;
  }
  seen /= counted;
  const Complex s(0, w);
  Complex wanted = rest;
  for (const auto& [k, r] : {std::pair{3, 0.2}, std::pair{5, 0.5}})
    wanted += gap * r * s / (s + 2 * kPi * RelaxationFrequency(k));
  wanted *= 1e-5;
  EXPECT_LT(std::abs(seen / wanted - 1.0), w * h * w * h / 12 + 0.5 * w * h);
  EXPECT_NEAR(std::abs(seen / wanted), 1, 0.005);
}

TEST(EddyImpedance, OnlyThePathStaysAtRest) {
  Plant with = PlantWith("eddy-impedance", "A", {{"path", 2e-5}, {"r3", 0.4}}),
        reluctance = PlantWith("iron-reluctance", "A", {{"path", 2e-5}});
  const double wanted = RestFlux(reluctance, Currents(2))[0];
  EXPECT_NEAR(RestFlux(with, Currents(2))[0], wanted, 1e-9 * std::abs(wanted));
}

// One operator of radius r: a loop between -B and B costs 4 N c (B - r).
TEST(PlayHysteresis, EveryOperatorHasItsOwnLoop) {
  for (const int k : {2, 8}) {
    Plant plant =
        PlantWith("play-hysteresis", "A", {{"width", 0.4}, {"c" + std::to_string(k), 0.1}});
    FluxLaw& law = *plant.bearings[0].laws.at(0);
    const double per_tesla = 1 / DensityPerFlux(plant.bearings[0]),
                 mmf = 0.1 * std::abs(plant.bearings[0].lanes.n[0]), r = 0.4 * k * k / 64, B = 0.7;
    law.Settle(Lane{});
    double area = 0, last = 0, last_drop = 0;
    const int steps = 8000;
    for (int n = 0; n <= 5 * steps / 4; ++n) {
      const double b = B * std::asin(std::sin(2 * kPi * n / steps)) * 2 / kPi;  // triangle
      const double drop = RefinedDropOf(law, b * per_tesla);
      law.Commit(Currents(b * per_tesla));
      if (n > steps / 4) area += 0.5 * (drop + last_drop) * (b - last);
      last = b;
      last_drop = drop;
    }
    EXPECT_NEAR(area / mmf, 4 * (B - r), 2e-3) << k;  // trapezoids at the corners
  }
}

}  // namespace
}  // namespace ambrig
