// Coloured noise is told from what a model lacks: that follows the motion, or is a line, or comes
// and goes with what drives the rig.
#include "discovery/data/stationary_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/noise.h"

namespace ambrig {
namespace {

constexpr std::size_t kRowsOfMotion = 512;

/// White noise of rms `rms` behind a resonance at 0.03 of the rate with a damping of 5 %.
std::vector<double> Resonant(std::uint64_t seed, std::size_t rows, double rms) {
  constexpr double kAngle = 2 * std::numbers::pi * 0.03, kDecay = 1 - 0.05 * kAngle;
  std::vector<double> out;
  double a = 0, b = 0, square = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const double next =
        Normal(seed, 1, k) + 2 * kDecay * std::cos(kAngle) * a - kDecay * kDecay * b;
    b = a;
    a = next;
    out.push_back(next);
    square += next * next;
  }
  for (double& v : out) v *= rms / std::sqrt(square / static_cast<double>(rows));
  return out;
}

/// Stretches of an error and of two predictions, the first of which moves by 0.1 in the first half
/// of them and by 2 in the second.
std::vector<DrivenStretch> Stretches(std::size_t count, const std::vector<double>& error) {
  std::vector<DrivenStretch> out(count);
  for (std::size_t k = 0; k < count * kRowsOfMotion; ++k) {
    DrivenStretch& s = out[k / kRowsOfMotion];
    s.predicted.resize(2);
    s.error.push_back(error[k] + 0.3 * Normal(9, 1, k));
    s.predicted[0].push_back((2 * k < count * kRowsOfMotion ? 0.1 : 2) * Normal(9, 2, k));
    s.predicted[1].push_back(Normal(9, 3, k));
  }
  return out;
}

TEST(StationaryNoise, ResonantNoiseIsNoise) {
  const auto noise = StationaryNoiseOf(Stretches(24, Resonant(1, 24 * kRowsOfMotion, 0.6)), 0.3);
  ASSERT_TRUE(noise);
  EXPECT_NEAR(noise->rms, std::hypot(0.6, 0.3), 0.01);
  EXPECT_NEAR(noise->middle, 0.03, 0.015);
}

TEST(StationaryNoise, ALineIsNone) {
  std::vector<double> line;
  for (std::size_t k = 0; k < 24 * kRowsOfMotion; ++k)
    line.push_back(0.6 * std::numbers::sqrt2 * std::sin(0.1933 * static_cast<double>(k)));
  EXPECT_FALSE(StationaryNoiseOf(Stretches(24, line), 0.3));
}

TEST(StationaryNoise, WhatComesWithTheMotionIsNone) {
  std::vector<double> error = Resonant(1, 24 * kRowsOfMotion, 0.6);
  for (std::size_t k = 0; k < 12 * kRowsOfMotion; ++k) error[k] *= 0.3;
  EXPECT_FALSE(StationaryNoiseOf(Stretches(24, error), 0.3));
}

// The motion of another channel, whose part here no own prediction shows.
TEST(StationaryNoise, WhatFollowsAnotherPredictionIsNone) {
  const std::vector<double> none(24 * kRowsOfMotion, 0.0);
  auto stretches = Stretches(24, none);
  EXPECT_TRUE(StationaryNoiseOf(stretches, 0.2));
  for (DrivenStretch& s : stretches)
    for (std::size_t k = 0; k < kRowsOfMotion; ++k) s.error[k] += 0.3 * s.predicted[1][k];
  EXPECT_FALSE(StationaryNoiseOf(stretches, 0.3));
}

TEST(StationaryNoise, FewStretchesOrStretchesDrivenAlikeDoNotTell) {
  const std::vector<double> error = Resonant(1, 24 * kRowsOfMotion, 0.6);
  EXPECT_FALSE(StationaryNoiseOf(Stretches(14, error), 0.3));
  auto alike = Stretches(24, error);
  for (DrivenStretch& s : alike) s.predicted[0] = s.predicted[1];
  EXPECT_FALSE(StationaryNoiseOf(alike, 0.3));
}

}  // namespace
}  // namespace ambrig
