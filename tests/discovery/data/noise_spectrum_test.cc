// Noise that a filter has passed is seen whole; an error that shows in some stretches only is none.
#include "discovery/data/noise_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"

namespace ambrig {
namespace {

constexpr std::size_t kRowsOfStretch = 1024;

/// White noise of rms 1 behind two equal low-passes (share of a row's difference that is followed),
/// which leave it `rms`.
std::vector<ErrorStretch> NoiseInStretches(std::size_t count, double follow, double rms) {
  std::vector<double> all;
  double a = 0, b = 0, square = 0;
  for (std::size_t k = 0; k < count * kRowsOfStretch; ++k) {
    a += follow * (Normal(5, 2, k) - a);
    b += follow * (a - b);
    all.push_back(b);
    square += b * b;
  }
  const double scale = rms / std::sqrt(square / static_cast<double>(all.size()));
  std::vector<ErrorStretch> out(count);
  for (std::size_t k = 0; k < all.size(); ++k) {
    out[k / kRowsOfStretch].error.push_back(scale * all[k]);
    out[k / kRowsOfStretch].predicted.push_back(Normal(6, 2, k));
  }
  return out;
}

TEST(NoiseSpectrum, OfWhiteNoiseIsWhite) {
  const FilteredNoise noise = NoiseOfStretches(NoiseInStretches(12, 1, 2), 2);
  EXPECT_NEAR(noise.rms, 2, 0.15);
  EXPECT_LT(noise.rows_per_number, 1.1);
}

// Low-passes at about 450 Hz of rows at 12.5 kHz: a tenth of the rows are numbers of their own.
TEST(NoiseSpectrum, OfFilteredNoiseIsAllOfIt) {
  const FilteredNoise noise = NoiseOfStretches(NoiseInStretches(12, 0.2, 0.5), 0.05);
  EXPECT_NEAR(noise.rms, 0.5, 0.06);
  EXPECT_GT(noise.rows_per_number, 4);
  EXPECT_LT(noise.rows_per_number, 30);
}

// What acts in half of the stretches is an error of the model.
TEST(NoiseSpectrum, WhatComesAndGoesIsNone) {
  auto stretches = NoiseInStretches(12, 1, 0.05);
  const auto error = NoiseInStretches(12, 0.05, 1);
  for (std::size_t s = 0; s < stretches.size(); s += 2)
    for (std::size_t k = 0; k < kRowsOfStretch; ++k) stretches[s].error[k] += error[s].error[k];
  EXPECT_NEAR(NoiseOfStretches(stretches, 0.05).rms, 0.05, 0.01);
}

// An error that follows the prediction is the model's, though it is alike in all stretches.
TEST(NoiseSpectrum, WhatFollowsThePredictionIsNone) {
  auto stretches = NoiseInStretches(12, 1, 0.05);
  const auto signal = NoiseInStretches(12, 0.2, 1);
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    stretches[s].predicted = signal[s].error;
    for (std::size_t k = 0; k < kRowsOfStretch; ++k)
      stretches[s].error[k] += 0.3 * signal[s].error[k];
  }
  EXPECT_LT(NoiseOfStretches(stretches, 0.05).rms, 0.08);
}

TEST(NoiseSpectrum, WithoutStretchesTheNoiseIsWhite) {
  EXPECT_EQ(NoiseOfStretches({}, 0.3).rms, 0.3);
}

}  // namespace
}  // namespace ambrig
