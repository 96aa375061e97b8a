#include "discovery/data/noise_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "core/math/constants.h"
#include "core/math/fft.h"
#include "discovery/data/noise_estimate.h"

namespace ambrig {

namespace {

constexpr double kDensitiesAgree = 1.35;  // of densities as rms, beside their scatter
constexpr double kOfQuartile = 0.6745;    // normal number that a quarter exceeds
constexpr double kFreedomOfLine = 1.05;   // of a line, with Hann's window
constexpr std::size_t kFirstLine = 2;     // line: below it the window holds the mean

/// What a quarter (z < 0) or three quarters of mean squares of this freedom stay below, of their expectation.
double QuantileOfPower(double freedom, double z) {
  const double part = 2 / (9 * freedom);
  return std::pow(1 - part + z * std::sqrt(part), 3);
}

/// Power density of each line [square of the unit], of white noise its variance.
std::vector<double> Periodogram(const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> windowed(n), power;
  double square = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double w =
        0.5 - 0.5 * std::cos(2 * kPi * static_cast<double>(k) / static_cast<double>(n));
    windowed[k] = w * x[k];
    square += w * w;
  }
  for (const std::complex<double>& c : RealFft(windowed)) power.push_back(std::norm(c) / square);
  return power;
}

}  // namespace

FilteredNoise NoiseOfStretches(const std::vector<std::vector<double>>& stretches, double white) {
  if (stretches.empty()) return {white, 1};
  std::vector<std::vector<double>> power;
  for (const std::vector<double>& s : stretches) power.push_back(Periodogram(s));
  const std::size_t lines = power[0].size() - 1;  // without the one at half the rate
  double sum = 0, square = 0;
  for (std::size_t from = kFirstLine; from < lines; from *= 2) {
    const std::size_t to = std::min(2 * from, lines), count = to - from;
    std::vector<double> means;
    for (const std::vector<double>& p : power) {
      double mean = 0;
      for (std::size_t k = from; k < to; ++k) mean += p[k] / static_cast<double>(count);
      means.push_back(mean);
    }
    const double freedom = std::max(2.0, kFreedomOfLine * static_cast<double>(count)),
                 low = QuantileOfPower(freedom, -kOfQuartile),
                 high = QuantileOfPower(freedom, kOfQuartile),
                 quarter = QuantileOf(means, 0.25) / low,
                 three_quarters = QuantileOf(means, 0.75) / high;
    const bool agree = three_quarters < kDensitiesAgree * kDensitiesAgree * quarter;
    const double density = agree ? quarter : white * white;
    // what lies below the first octave is taken for as dense
    const auto covered = static_cast<double>(from == kFirstLine ? to : count);
    sum += covered * density;
    square += covered * density * density;
  }
  const auto n = static_cast<double>(lines);
  return {std::sqrt(sum / n), std::max(1.0, n * square / (sum * sum))};
}

}  // namespace ambrig
