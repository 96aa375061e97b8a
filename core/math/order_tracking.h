#pragma once
/// What turns with the shaft and what does not, from the motion of a shaft centre while the speed
/// changes. z = x + i y is the orbit as one complex signal: e^{+i w t} turns forward (with the
/// shaft at theta' > 0), e^{-i w t} backward.
///
///   order n:     Z_n(t) = Σ w_k z_k e^{-i n theta_k} / Σ w_k,  w: Hann window of `span` round t
///   waterfall:   |Z(f, t)|, f from -f_max to +f_max, the same window moved along the record
///
/// Both are amplitudes in the signal's unit; the mean over the window is taken out first. An order
/// is resolved from its neighbours when the window holds a few turns: with fewer than kLeastTurns
/// it is NaN.
#include <complex>
#include <span>
#include <vector>

namespace ambrig {

inline constexpr double kLeastTurns = 3;

/// A shaft centre's motion on a uniform time base.
struct Orbit {
  std::span<const double> x, y;  // [m], of one size
  double rate = 1, start = 0;    // [Hz], [s]
};

struct TrackedOrder {
  std::vector<double> t;                                // centres of the windows [s]
  std::vector<std::complex<double>> forward, backward;  // Z_n and Z_-n [m]
};

/// `theta`: shaft angle [rad], unwrapped, one per sample; `span` [s]; one value every `hop` [s].
TrackedOrder TrackOrder(const Orbit& orbit, std::span<const double> theta, double order,
                        double span, double hop);

struct WaterfallSpectrum {
  std::vector<double> t;                       // centres of the windows [s]
  std::vector<double> frequency;               // [Hz], negative: backward
  std::vector<std::vector<double>> amplitude;  // [t][frequency], of a circular motion [m]
};

/// At most `lines` frequencies between -f_max and f_max: the largest of neighbours stands for them.
WaterfallSpectrum Waterfall(const Orbit& orbit, double span, double hop, double f_max,
                            std::size_t lines = 241);

}  // namespace ambrig
