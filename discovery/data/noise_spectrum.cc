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
// Squared coherence with the prediction from which an error is the model's; of 16 lines of noise 1
// % have as much.
constexpr double kCoherentError = 0.25;
constexpr double kOfQuartile = 0.6745;   // normal number that a quarter exceeds
constexpr double kFreedomOfLine = 1.05;  // of a line, with Hann's window
constexpr std::size_t kFirstLine = 2;    // line: below it the window holds the mean

/// What a quarter (z < 0) or three quarters of mean squares of this freedom stay below, of their
/// expectation.
double QuantileOfPower(double freedom, double z) {
  const double part = 2 / (9 * freedom);
  return std::pow(1 - part + z * std::sqrt(part), 3);
}

using StretchLines = std::vector<std::complex<double>>;

/// Of each line; its square is the power density [square of the unit], of white noise its variance.
StretchLines LinesOfStretch(const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> windowed(n);
  double square = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double w =
        0.5 - 0.5 * std::cos(2 * kPi * static_cast<double>(k) / static_cast<double>(n));
    windowed[k] = w * x[k];
    square += w * w;
  }
  StretchLines lines = RealFft(windowed);
  for (std::complex<double>& c : lines) c /= std::sqrt(square);
  return lines;
}

/// Mean power of these lines in each stretch.
std::vector<double> LinePowers(const std::vector<StretchLines>& of, std::size_t from,
                               std::size_t to) {
  std::vector<double> means;
  for (const StretchLines& lines : of) {
    double mean = 0;
    for (std::size_t k = from; k < to; ++k)
      mean += std::norm(lines[k]) / static_cast<double>(to - from);
    means.push_back(mean);
  }
  return means;
}

/// Squared coherence of these lines in all stretches, 0 to 1.
double LineCoherence(const std::vector<StretchLines>& a, const std::vector<StretchLines>& b,
                     std::size_t from, std::size_t to) {
  std::complex<double> product = 0;
  double of_a = 0, of_b = 0;
  for (std::size_t s = 0; s < a.size(); ++s)
    for (std::size_t k = from; k < to; ++k) {
      product += std::conj(a[s][k]) * b[s][k];
      of_a += std::norm(a[s][k]);
      of_b += std::norm(b[s][k]);
    }
  return of_a > 0 && of_b > 0 ? std::norm(product) / of_a / of_b : 0;
}

}  // namespace

FilteredNoise NoiseOfStretches(const std::vector<ErrorStretch>& stretches, double white) {
  if (stretches.empty()) return {white, 1};
  std::vector<StretchLines> error, predicted;
  for (const ErrorStretch& s : stretches) {
    error.push_back(LinesOfStretch(s.error));
    predicted.push_back(LinesOfStretch(s.predicted));
  }
  const std::size_t lines = error[0].size() - 1;  // without the one at half the rate
  double sum = 0, square = 0;
  for (std::size_t from = kFirstLine; from < lines; from *= 2) {
    const std::size_t to = std::min(2 * from, lines), count = to - from;
    const std::vector<double> means = LinePowers(error, from, to);
    const double freedom = std::max(2.0, kFreedomOfLine * static_cast<double>(count)),
                 low = QuantileOfPower(freedom, -kOfQuartile),
                 high = QuantileOfPower(freedom, kOfQuartile),
                 quarter = QuantileOf(means, 0.25) / low,
                 three_quarters = QuantileOf(means, 0.75) / high;
    const bool agree = LineCoherence(error, predicted, from, to) < kCoherentError &&
                       three_quarters < kDensitiesAgree * kDensitiesAgree * quarter;
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
