#include "core/math/order_tracking.h"

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/math/constants.h"
#include "core/math/fft.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

// Of a window by zeros: a motion between two lines of the bare window would look 15 % smaller, here
// 1 %.
constexpr std::size_t kPadding = 4;

std::vector<double> HannWeights(std::size_t n) {
  std::vector<double> w(n);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    w[k] = 1 - std::cos(2 * kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
    sum += w[k];
  }
  for (double& v : w) v /= sum;
  return w;
}

/// Calls visit(first sample, centre in s) for every window that fits.
template <class Visit>
void EachWindow(const Orbit& orbit, std::size_t n, double hop, const Visit& visit) {
  Require(orbit.x.size() == orbit.y.size(), "x and y of one size");
  const auto step = static_cast<std::size_t>(std::max(1.0, std::round(hop * orbit.rate)));
  for (std::size_t at = 0; at + n <= orbit.x.size(); at += step)
    visit(at,
          orbit.start + (static_cast<double>(at) + 0.5 * static_cast<double>(n - 1)) / orbit.rate);
}

std::size_t WindowSize(const Orbit& orbit, double span) {
  return static_cast<std::size_t>(std::max(8.0, std::round(span * orbit.rate)));
}

Complex WeightedMean(const Orbit& orbit, const std::vector<double>& w, std::size_t at) {
  Complex mean = 0;
  for (std::size_t k = 0; k < w.size(); ++k)
    mean += w[k] * Complex(orbit.x[at + k], orbit.y[at + k]);
  return mean;
}

}  // namespace

TrackedOrder TrackOrder(const Orbit& orbit, std::span<const double> theta, double order,
                        double span, double hop) {
  Require(theta.size() == orbit.x.size(), "an angle per sample");
  TrackedOrder out;
  const std::vector<double> w = HannWeights(WindowSize(orbit, span));
  EachWindow(orbit, w.size(), hop, [&](std::size_t at, double t) {
    const Complex mean = WeightedMean(orbit, w, at);
    Complex forward = 0, backward = 0;
    for (std::size_t k = 0; k < w.size(); ++k) {
      const Complex z = w[k] * (Complex(orbit.x[at + k], orbit.y[at + k]) - mean);
      const Complex turn = std::polar(1.0, order * theta[at + k]);
      forward += z * std::conj(turn);
      backward += z * turn;
    }
    const double turns = order * std::abs(theta[at + w.size() - 1] - theta[at]) / (2 * kPi);
    if (turns < kLeastTurns) forward = backward = {std::nan(""), std::nan("")};
    out.t.push_back(t);
    out.forward.push_back(forward);
    out.backward.push_back(backward);
  });
  return out;
}

WaterfallSpectrum Waterfall(const Orbit& orbit, double span, double hop, double f_max,
                            std::size_t lines) {
  WaterfallSpectrum out;
  const std::vector<double> w = HannWeights(WindowSize(orbit, span));
  const std::size_t n = w.size(), padded = kPadding * n;
  const double df = orbit.rate / static_cast<double>(padded);
  const auto top = std::min<std::size_t>(padded / 2, static_cast<std::size_t>(f_max / df));
  // `merge` neighbouring bins share a line, so that no narrow peak falls between two.
  const std::size_t merge = std::max<std::size_t>(1, (2 * top + lines) / lines);
  const std::size_t half = top / merge;
  for (std::size_t k = 0; k <= 2 * half; ++k)
    out.frequency.push_back((static_cast<double>(k) - static_cast<double>(half)) *
                            static_cast<double>(merge) * df);
  EachWindow(orbit, n, hop, [&](std::size_t at, double t) {
    const Complex mean = WeightedMean(orbit, w, at);
    std::vector<double> x(padded, 0.0), y(padded, 0.0), row(2 * half + 1, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      x[k] = w[k] * (orbit.x[at + k] - mean.real());
      y[k] = w[k] * (orbit.y[at + k] - mean.imag());
    }
    const std::vector<Complex> X = RealFft(x), Y = RealFft(y);
    for (std::size_t k = 0; k < X.size() && (k + merge / 2) / merge <= half; ++k) {
      const std::size_t line = (k + merge / 2) / merge;
      const Complex iY = Complex(0, 1) * Y[k];
      row[half + line] = std::max(row[half + line], std::abs(X[k] + iY));
      row[half - line] = std::max(row[half - line], std::abs(X[k] - iY));
    }
    out.t.push_back(t);
    out.amplitude.push_back(std::move(row));
  });
  return out;
}

}  // namespace ambrig
