#pragma once
/// Spectra of real signals (Eigen's FFT; any length, powers of 2, 3, 5 are fast).
///
///   X_k  = Σ x_n exp(-2πi k n / N),  k = 0 .. N/2                     transform
///   S_xx = 2 <|X_k|²> / (rate Σ w_n²)   (k = 0 and N/2: without 2)     power density, one-sided
///   H1   = <X* Y> / <X* X>,  γ² = |<X* Y>|² / (<X* X> <Y* Y>)         response, coherence
///
/// <> is the mean over segments that overlap by one half, each without its mean and times the
/// window w. Source: Welch 1967; Bendat and Piersol, "Random data", 4th ed., ch. 9 and 11.
#include <complex>
#include <span>
#include <vector>

namespace ambrig {

enum class Window { kRectangular, kHann };

/// X_k, N/2 + 1 values.
std::vector<std::complex<double>> RealFft(std::span<const double> x);

/// The signal of length n whose RealFft is `spectrum` (n/2 + 1 values).
std::vector<double> InverseRealFft(const std::vector<std::complex<double>>& spectrum,
                                   std::size_t n);

struct AmplitudeSpectrum {
  std::vector<double> frequency;  // [Hz]
  std::vector<double> amplitude;  // of a sine at that frequency, unit of the signal; mean at 0 Hz
};

/// Of the whole signal; a sine between two lines loses up to 36 % (rectangular) or 15 % (Hann).
AmplitudeSpectrum SpectrumAmplitude(std::span<const double> x, double rate,
                                    Window window = Window::kHann);

struct PowerDensity {
  std::vector<double> frequency;  // [Hz]
  std::vector<double> density;    // [unit²/Hz], one-sided: its integral is the variance
  int segments = 0;
};

/// `segment` samples each, 2 <= segment <= x.size().
PowerDensity WelchPsd(std::span<const double> x, double rate, std::size_t segment,
                      Window window = Window::kHann);

struct ResponseEstimate {
  std::vector<double> frequency;               // [Hz]
  std::vector<std::complex<double>> response;  // H1, output per input; 0 where nothing is put in
  std::vector<double> coherence;               // 0 .. 1; 1 always if there is one segment only
  int segments = 0;
};

/// H1 is unbiased by noise in the output. Rectangular: for signals periodic in the segment.
ResponseEstimate EstimateResponse(std::span<const double> input, std::span<const double> output,
                                  double rate, std::size_t segment, Window window = Window::kHann);

}  // namespace ambrig
