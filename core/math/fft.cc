#include "core/math/fft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "core/base/errors.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

/// Periodic form, whose overlapping copies add up to a constant.
std::vector<double> MakeWindow(Window window, std::size_t n) {
  std::vector<double> w(n, 1.0);
  if (window == Window::kHann)
    for (std::size_t k = 0; k < n; ++k)
      w[k] = 0.5 -
             0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
  return w;
}

std::vector<double> Frequencies(std::size_t n, double rate) {
  std::vector<double> f(n / 2 + 1);
  for (std::size_t k = 0; k < f.size(); ++k)
    f[k] = rate * static_cast<double>(k) / static_cast<double>(n);
  return f;
}

/// Lines that stand for a positive and a negative frequency: not 0 and not half the rate.
bool IsPaired(std::size_t line, std::size_t n) { return line != 0 && 2 * line != n; }

std::vector<Complex> Transform(Eigen::FFT<double>& fft, std::vector<double>& x) {
  std::vector<Complex> spectrum;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  fft.fwd(spectrum, x);
  spectrum.resize(x.size() / 2 + 1);
  return spectrum;
}

/// Windowed spectra of the segments of one signal, one after the other.
class Segments {
 public:
  Segments(std::span<const double> x, std::size_t segment, Window window)
      : x_(x), w_(MakeWindow(window, segment)) {
    Require(segment >= 2 && segment <= x.size(), "2 <= segment <= length of the signal");
  }

  bool Done() const { return begin_ + w_.size() > x_.size(); }

  std::vector<Complex> Next() {
    const std::size_t n = w_.size();
    std::vector<double> part(x_.begin() + static_cast<std::ptrdiff_t>(begin_),
                             x_.begin() + static_cast<std::ptrdiff_t>(begin_ + n));
    double mean = 0;
    for (double v : part) mean += v;
    mean /= static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) part[k] = (part[k] - mean) * w_[k];
    begin_ += n - n / 2;
    return Transform(fft_, part);
  }

  double WindowPower() const {
    double sum = 0;
    for (double w : w_) sum += w * w;
    return sum;
  }

 private:
  std::span<const double> x_;
  std::vector<double> w_;
  std::size_t begin_ = 0;
  Eigen::FFT<double> fft_;
};

}  // namespace

std::vector<Complex> RealFft(std::span<const double> x) {
  Require(!x.empty(), "a signal with samples");
  if (x.size() == 1) return {x[0]};
  Eigen::FFT<double> fft;
  std::vector<double> copy(x.begin(), x.end());
  return Transform(fft, copy);
}

std::vector<double> InverseRealFft(const std::vector<Complex>& spectrum, std::size_t n) {
  Require(n > 0 && spectrum.size() == n / 2 + 1, "n/2 + 1 lines");
  if (n == 1) return {spectrum[0].real()};
  std::vector<Complex> both(n), x;  // the library's half-spectrum form takes even lengths only
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    both[k] = spectrum[k];
    if (IsPaired(k, n)) both[n - k] = std::conj(spectrum[k]);
  }
  Eigen::FFT<double> fft;
  fft.inv(x, both);
  std::vector<double> real(n);
  std::transform(x.begin(), x.end(), real.begin(), [](const Complex& c) { return c.real(); });
  return real;
}

AmplitudeSpectrum SpectrumAmplitude(std::span<const double> x, double rate, Window window) {
  Require(!x.empty(), "a signal with samples");
  const std::size_t n = x.size();
  const std::vector<double> w = MakeWindow(window, n);
  double mean = 0, weight = 0;
  for (std::size_t k = 0; k < n; ++k) {
    mean += x[k] / static_cast<double>(n);
    weight += w[k];
  }
  // The window would smear the mean over the first lines.
  std::vector<double> windowed(n);
  for (std::size_t k = 0; k < n; ++k) windowed[k] = (x[k] - mean) * w[k];
  const std::vector<Complex> spectrum = RealFft(windowed);
  AmplitudeSpectrum out{Frequencies(n, rate), std::vector<double>(spectrum.size())};
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    out.amplitude[k] = weight > 0 ? std::abs(spectrum[k]) * (IsPaired(k, n) ? 2 : 1) / weight : 0;
  out.amplitude[0] = std::abs(mean);
  return out;
}

PowerDensity WelchPsd(std::span<const double> x, double rate, std::size_t segment, Window window) {
  Segments segments(x, segment, window);
  PowerDensity out{Frequencies(segment, rate), std::vector<double>(segment / 2 + 1)};
  for (; !segments.Done(); ++out.segments) {
    const std::vector<Complex> X = segments.Next();
    for (std::size_t k = 0; k < X.size(); ++k) out.density[k] += std::norm(X[k]);
  }
  const double scale = 1 / (rate * segments.WindowPower() * out.segments);
  for (std::size_t k = 0; k < out.density.size(); ++k)
    out.density[k] *= IsPaired(k, segment) ? 2 * scale : scale;
  return out;
}

ResponseEstimate EstimateResponse(std::span<const double> input, std::span<const double> output,
                                  double rate, std::size_t segment, Window window) {
  Require(input.size() == output.size(), "input as long as output");
  Segments in(input, segment, window), out(output, segment, window);
  const std::size_t lines = segment / 2 + 1;
  std::vector<double> xx(lines), yy(lines);
  std::vector<Complex> xy(lines);
  ResponseEstimate result{Frequencies(segment, rate), std::vector<Complex>(lines),
                          std::vector<double>(lines)};
  for (; !in.Done(); ++result.segments) {
    const std::vector<Complex> X = in.Next(), Y = out.Next();
    for (std::size_t k = 0; k < lines; ++k) {
      xx[k] += std::norm(X[k]);
      yy[k] += std::norm(Y[k]);
      xy[k] += std::conj(X[k]) * Y[k];
    }
  }
  for (std::size_t k = 0; k < lines; ++k) {
    if (xx[k] > 0) result.response[k] = xy[k] / xx[k];
    if (xx[k] > 0 && yy[k] > 0)  // in two steps: the product may underflow
      result.coherence[k] = std::min(1.0, std::norm(xy[k]) / xx[k] / yy[k]);
  }
  return result;
}

}  // namespace ambrig
