#pragma once
/// Least-squares slopes over the samples of one phase of a period, all coils in lanes. Only for
/// sources that hold a hot loop.
#include "fdd/circuit/flux_circuit.h"
#include "fdd/measurement/sample_places.h"

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

/// How many samples of a phase count, and the mean of their numbers k.
template <class V>
struct Places {
  V count = 0.0, middle = 0.0;
  /// The samples from `first` to the one before `end`.
  [[gnu::always_inline]] static Places Between(const V& first, const V& end) {
    Places out;
    out.count = end - first;
    out.middle = (first + end - 1.0) * 0.5;
    return out;
  }
};

/// The same of samples that are added one after the other.
template <class V>
struct PlaceSums {
  V count = 0.0, from_end = 0.0;
  template <class Mask>
  [[gnu::always_inline]] void Add(const Mask& in) {
    count += Only(in, 1.0);
    from_end += count;
  }
  [[gnu::always_inline]] Places<V> Until(const V& end) const {
    Places<V> out;
    out.count = count;
    out.middle = (count * end - from_end) / Max(count, 1.0);
    return out;
  }
};

/// `end`: number of samples of the period, sample k is in its sums `end` - k times.
template <class V>
[[gnu::always_inline]] inline void Finish(const PhaseSums<V>& s, const Places<V>& places,
                                          const V& sense, int end, double step, FluxPhase* out) {
  const V ky = s.y * end - s.y_after, ki = s.i * end - s.i_after;
  const auto enough = Below(kFewestForSlope - 0.5, places.count);
  const V n = Choose(enough, places.count, 2), spread = n * (n * n - 1) * (step / 12),
          per = Only(enough, 1 / spread), mean = s.i / n;
  Store(out->samples.v, Only(enough, places.count));
  Store(out->flux.v, sense * (ky - places.middle * s.y) * per);
  Store(out->current.v, (ki - places.middle * s.i) * per);
  Store(out->mean.v, Only(enough, mean));
  Store(out->scale.v, per * (1 / step));
}

}  // namespace ambrig
