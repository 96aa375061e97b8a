#include "discovery/data/stretch_lines.h"

#include <algorithm>
#include <cmath>

#include "core/math/chi_squared.h"
#include "core/math/constants.h"
#include "core/math/fft.h"
#include "discovery/data/noise_estimate.h"

namespace ambrig {

namespace {

constexpr double kDensitiesAgree = 1.35;  // of densities as rms, beside their scatter
constexpr double kOfQuartile = 0.6745;    // normal number that a quarter exceeds
constexpr double kFreedomOfLine = 1.05;   // of a line, with Hann's window
constexpr std::size_t kFirstLine = 2;

/// Mean power of these lines in each stretch.
std::vector<double> StretchPowers(const std::vector<StretchLines>& of, const LineBand& band) {
  std::vector<double> means;
  for (const StretchLines& lines : of) {
    double mean = 0;
    for (std::size_t k = band.from; k < band.to; ++k)
      mean += std::norm(lines[k]) / static_cast<double>(band.count());
    means.push_back(mean);
  }
  return means;
}

}  // namespace

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

std::vector<LineBand> OctavesOf(const StretchLines& lines) {
  const std::size_t end = lines.size() - 1;
  std::vector<LineBand> octaves;
  for (std::size_t from = kFirstLine; from < end; from *= 2)
    octaves.push_back({from, std::min(2 * from, end)});
  return octaves;
}

double LineCoherence(const std::vector<StretchLines>& a, const std::vector<StretchLines>& b,
                     const LineBand& band) {
  std::complex<double> product = 0;
  double of_a = 0, of_b = 0;
  for (std::size_t s = 0; s < a.size(); ++s)
    for (std::size_t k = band.from; k < band.to; ++k) {
      product += std::conj(a[s][k]) * b[s][k];
      of_a += std::norm(a[s][k]);
      of_b += std::norm(b[s][k]);
    }
  return of_a > 0 && of_b > 0 ? std::norm(product) / of_a / of_b : 0;
}

bool DensityRange::Agrees() const {
  return three_quarters < kDensitiesAgree * kDensitiesAgree * quarter;
}

std::vector<LinePower> PowersOf(const std::vector<StretchLines>& of, const LineBand& band) {
  std::vector<LinePower> out;
  const auto n = static_cast<double>(of.size());
  for (std::size_t k = band.from; k < band.to; ++k) {
    double sum = 0, square = 0;
    for (const StretchLines& lines : of) {
      const double power = std::norm(lines[k]);
      sum += power;
      square += power * power;
    }
    out.push_back({sum / n, square / n - sum / n * sum / n});
  }
  return out;
}

double IndependentLines(const std::vector<LinePower>& powers) {
  double sum = 0, square = 0;
  for (const LinePower& line : powers) {
    sum += line.mean;
    square += line.mean * line.mean;
  }
  return square > 0 ? sum * sum / square : static_cast<double>(powers.size());
}

DensityRange DensitiesOf(const std::vector<StretchLines>& of, const LineBand& band,
                         double independent) {
  const std::vector<double> means = StretchPowers(of, band);
  const double freedom = std::max(2.0, kFreedomOfLine * independent);
  return {QuantileOf(means, 0.25) / QuantileOfMeanSquare(freedom, -kOfQuartile),
          QuantileOf(means, 0.75) / QuantileOfMeanSquare(freedom, kOfQuartile)};
}

}  // namespace ambrig
