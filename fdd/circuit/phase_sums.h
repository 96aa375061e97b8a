#pragma once
/// Least-squares slopes over the samples of one phase of a period, all coils in lanes. Only for
/// sources that hold a hot loop.
#include "actuators/magnetics/whole_lane_vector.h"
#include "fdd/circuit/flux_circuit.h"

namespace ambrig {

inline constexpr double kFewestForSlope = 3;  // of a phase that has slopes

/// Sums over the samples of a phase that count; those over k are sums of the sums so far,
/// taken back to k = 0 at the end.
template <class V>
struct PhaseSums {
  V y = 0.0, y_after = 0.0, i = 0.0, i_after = 0.0;
  template <class Mask>
  [[gnu::always_inline]] void Add(const Mask& in, const V& psi, const V& current) {
    y += Only(in, psi);
    y_after += y;
    i += Only(in, current);
    i_after += i;
  }
};

/// How many samples of a phase count, and the sum of their numbers k.
template <class V>
struct Places {
  V count = 0.0, sum = 0.0;
  /// The samples from `first` to the one before `end`.
  [[gnu::always_inline]] static Places Between(const V& first, const V& end) {
    Places out;
    out.count = end - first;
    out.sum = (first + end - 1.0) * out.count * 0.5;
    return out;
  }
  /// One sample after the other; then `sum` is from the end until FromStart(end).
  template <class Mask>
  [[gnu::always_inline]] void Add(const Mask& in) {
    count += Only(in, 1.0);
    sum += count;
  }
  [[gnu::always_inline]] void FromStart(const V& end) { sum = count * end - sum; }
};

/// How many of the samples 0, 1, ... before `end` come before `x`: x rounded
/// up, within 0 and `end`.
template <class V>
[[gnu::always_inline]] inline V SamplesBefore(const V& x, const V& end) {
  constexpr double kRounds = 6755399441055744.0;  // 1.5 * 2^52: what is added to it has no fraction
  const V within = Min(Max(x, 0.0), end), nearest = (within + kRounds) - kRounds;
  return nearest + Only(Below(nearest, within), 1.0);
}

/// `end`: number of samples of the period, sample k is in its sums `end` - k times.
template <class V>
[[gnu::always_inline]] inline void Finish(const PhaseSums<V>& s, const Places<V>& places,
                                          const V& sense, int end, double step, FluxPhase* out) {
  const V ky = s.y * end - s.y_after, ki = s.i * end - s.i_after;
  const auto enough = Below(kFewestForSlope - 0.5, places.count);
  const V n = Choose(enough, places.count, 2), spread = n * (n * n - 1) * (step / 12),
          per = Only(enough, 1 / spread), mean = s.i / n, middle = places.sum / n;
  Store(out->samples.v, Only(enough, places.count));
  Store(out->flux.v, sense * (ky - middle * s.y) * per);
  Store(out->current.v, (ki - middle * s.i) * per);
  Store(out->mean.v, Only(enough, mean));
  Store(out->scale.v, per * (1 / step));
}

}  // namespace ambrig
