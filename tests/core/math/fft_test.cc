#include "core/math/fft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/math/constants.h"
#include "core/math/noise.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

std::vector<double> White(std::size_t n, std::uint32_t stream) {
  std::vector<float> normals(n);
  FillNormals(1, stream, 0, normals.data(), static_cast<int>(n));
  return {normals.begin(), normals.end()};
}

std::vector<double> Sine(std::size_t n, double rate, double f, double amplitude) {
  std::vector<double> x(n);
  for (std::size_t k = 0; k < n; ++k)
    x[k] = amplitude * std::sin(2 * kPi * f * static_cast<double>(k) / rate + 0.3);
  return x;
}

/// y_k = a y_(k-1) + (1 - a) x_k, H = (1 - a) / (1 - a exp(-iω)).
constexpr double kPole = 0.8;
std::vector<double> Filter(const std::vector<double>& x) {
  std::vector<double> y(x.size());
  double state = 0;
  for (std::size_t k = 0; k < x.size(); ++k) y[k] = state = kPole * state + (1 - kPole) * x[k];
  return y;
}
Complex FilterResponse(double f, double rate) {
  return (1 - kPole) / (1.0 - kPole * std::polar(1.0, -2 * kPi * f / rate));
}

// Rounding grows like log N; 1e-12 leaves two digits.
TEST(Fft, EqualsTheSumThatDefinesItAndInverts) {
  for (std::size_t n : {1, 2, 3, 4, 7, 12, 45, 64, 97, 250}) {
    const std::vector<double> x = White(n, 1);
    const std::vector<Complex> X = RealFft(x);
    ASSERT_EQ(X.size(), n / 2 + 1);
    for (std::size_t k = 0; k < X.size(); ++k) {
      Complex sum = 0;
      for (std::size_t m = 0; m < n; ++m)
        sum += x[m] *
               std::polar(1.0, -2 * kPi * static_cast<double>(k * m % n) / static_cast<double>(n));
      EXPECT_LT(std::abs(X[k] - sum), 1e-12 * static_cast<double>(n)) << n << ' ' << k;
    }
    const std::vector<double> back = InverseRealFft(X, n);
    ASSERT_EQ(back.size(), n);
    for (std::size_t m = 0; m < n; ++m) EXPECT_NEAR(back[m], x[m], 1e-12) << n;
  }
}

TEST(Fft, SineOnALineHasItsAmplitude) {
  const double rate = 12500;
  std::vector<double> x = Sine(2500, rate, 60, 3e-5);  // line 12
  for (double& v : x) v += -2e-5;
  const AmplitudeSpectrum plain = SpectrumAmplitude(x, rate, Window::kRectangular);
  const AmplitudeSpectrum hann = SpectrumAmplitude(x, rate);
  EXPECT_DOUBLE_EQ(plain.frequency[12], 60.0);
  EXPECT_DOUBLE_EQ(plain.frequency.back(), 6250.0);
  for (const AmplitudeSpectrum* s : {&plain, &hann}) {
    EXPECT_NEAR(s->amplitude[0], 2e-5, 1e-16);
    EXPECT_NEAR(s->amplitude[12], 3e-5, 1e-16);
    EXPECT_NEAR(s->amplitude[20], 0, 1e-16);
  }
  EXPECT_NEAR(plain.amplitude[13], 0, 1e-16);
  EXPECT_NEAR(hann.amplitude[13], 1.5e-5, 1e-16);  // Hann: neighbours have one half
}

TEST(Fft, SineBetweenTwoLinesLosesWhatTheWindowSays) {
  const double rate = 1000;
  const std::vector<double> x = Sine(1000, rate, 200.5, 1);
  // Dirichlet kernel at half a line 2/π, Hann 8/(3π); the image at -200.5 Hz adds up to 1/(2π 200).
  const AmplitudeSpectrum plain = SpectrumAmplitude(x, rate, Window::kRectangular);
  EXPECT_NEAR(plain.amplitude[200], 2 / kPi, 3e-3);
  EXPECT_NEAR(SpectrumAmplitude(x, rate).amplitude[200], 8 / (3 * kPi), 1e-4);
}

// Parseval: for a sine on a line 3 or more from 0 and N/2 the integral is exactly A²/2.
TEST(Fft, DensityIntegratesToTheVariance) {
  const double rate = 2000;
  for (Window window : {Window::kRectangular, Window::kHann}) {
    const PowerDensity psd = WelchPsd(Sine(4000, rate, 100, 3), rate, 500, window);
    double integral = 0;
    for (double s : psd.density) integral += s * rate / 500;
    EXPECT_NEAR(integral, 4.5, 1e-11);
    EXPECT_EQ(psd.segments, 15);  // begin at 0, 250 .. 3500
    EXPECT_DOUBLE_EQ(psd.frequency[25], 100.0);
  }
}

// White noise of variance 1 has 2/rate everywhere. One line's mean over n segments varies by
// 1/sqrt(n) (somewhat more for overlap); over 200 lines by 1/sqrt(200 n / 2).
TEST(Fft, WhiteNoiseIsFlat) {
  const double rate = 1000;
  const std::size_t segment = 512;
  const PowerDensity psd = WelchPsd(White(200000, 2), rate, segment);
  const double n = psd.segments / 1.1;
  for (std::size_t from : {5u, 30u}) {
    double mean = 0;
    for (std::size_t k = from; k < from + 200; ++k) mean += psd.density[k] / 200;
    EXPECT_NEAR(mean * rate / 2, 1, 5 / std::sqrt(200 * n / 2));
  }
  for (std::size_t k = 2; k < 255; ++k) EXPECT_NEAR(psd.density[k] * rate / 2, 1, 6 / std::sqrt(n));
}

TEST(Fft, ResponseToAPeriodicSignalIsExact) {
  const double rate = 1000;
  const std::size_t period = 360;
  const std::vector<double> one = White(period, 3);
  std::vector<double> x;
  for (int k = 0; k < 6; ++k) x.insert(x.end(), one.begin(), one.end());
  std::vector<double> y = Filter(x);
  // 0.8^720 = 1e-70 of the start is left after two periods.
  x.erase(x.begin(), x.begin() + 720);
  y.erase(y.begin(), y.begin() + 720);
  const ResponseEstimate h = EstimateResponse(x, y, rate, period, Window::kRectangular);
  for (std::size_t k = 1; k <= period / 2; ++k) {
    EXPECT_LT(std::abs(h.response[k] - FilterResponse(h.frequency[k], rate)), 1e-10) << k;
    EXPECT_NEAR(h.coherence[k], 1, 1e-10);
  }
}

// Noise of variance s² behind the filter: γ² = |H|² / (|H|² + s²), and H1 keeps its mean, with the
// standard deviation sqrt((1 - γ²) / (2 γ² n)) |H| of magnitude (Bendat and Piersol, table 9.6).
TEST(Fft, OutputNoiseLowersTheCoherenceNotTheResponse) {
  const double rate = 1000, s = 0.3;
  const std::vector<double> x = White(400000, 4), noise = White(400000, 5);
  std::vector<double> y = Filter(x);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += s * noise[k];
  const ResponseEstimate h = EstimateResponse(x, y, rate, 512);
  const double n = h.segments / 1.1;
  for (std::size_t k : {3u, 10u, 40u, 100u, 200u}) {
    const Complex H = FilterResponse(h.frequency[k], rate);
    const double g = std::norm(H) / (std::norm(H) + s * s);
    // The curvature of H over a Hann line: |H''| df² / 2 < 1e-3 at this segment length.
    EXPECT_LT(std::abs(h.response[k] - H), 5 * std::abs(H) * std::sqrt((1 - g) / (g * n)) + 1e-3)
        << k;
    EXPECT_NEAR(h.coherence[k], g, 5 * (1 - g) * std::sqrt(2 * g / n) + 1.0 / n) << k;
  }
}

TEST(Fft, NothingPutInGivesNoResponse) {
  const std::vector<double> zero(100, 0.0), x = White(100, 6);
  const ResponseEstimate h = EstimateResponse(zero, x, 1, 50);
  for (std::size_t k = 0; k <= 25; ++k) {
    EXPECT_EQ(h.response[k], 0.0);
    EXPECT_EQ(h.coherence[k], 0.0);
  }
  EXPECT_THROW(WelchPsd(x, 1, 101), std::logic_error);
  EXPECT_THROW(EstimateResponse(x, zero, 1, 1), std::logic_error);
  EXPECT_THROW(RealFft({}), std::logic_error);
}

}  // namespace
}  // namespace ambrig
