#pragma once
/// Least-squares slopes over the samples of one phase of a period, all coils in lanes. Only for
/// sources that hold a hot loop.
#include "actuators/magnetics/whole_lane_vector.h"
#include "fdd/model/flux_circuit.h"

namespace ambrig {

inline constexpr double kFewestForSlope = 3;  // of a phase that has slopes

/// Sums over the counted samples of a phase; those over k are sums of the sums so far, taken back to
/// k = 0 at the end.
template <class V>
struct PhaseSums {
  V y = 0.0, y_after = 0.0, i = 0.0, i_after = 0.0, count = 0.0, count_after = 0.0;
  template <class Mask>
  [[gnu::always_inline]] void Add(const Mask& in, const V& psi, const V& current) {
    y += Only(in, psi);
    y_after += y;
    i += Only(in, current);
    i_after += i;
    count += Only(in, 1.0);
    count_after += count;
  }
};

/// `end`: number of samples of the period, sample k is in its sums `end` - k times.
template <class V>
[[gnu::always_inline]] inline void Finish(const PhaseSums<V>& s, const V& sense, int end,
                                          double step, FluxPhase* out) {
  const V ky = s.y * end - s.y_after, ki = s.i * end - s.i_after,
          k_sum = s.count * end - s.count_after;
  const auto enough = Below(kFewestForSlope - 0.5, s.count);
  const V n = Choose(enough, s.count, 2), spread = n * (n * n - 1) * (step / 12),
          per = Only(enough, 1 / spread), mean = s.i / n, middle = k_sum / n;
  Store(out->samples.v, Only(enough, s.count));
  Store(out->flux.v, sense * (ky - middle * s.y) * per);
  Store(out->current.v, (ki - middle * s.i) * per);
  Store(out->mean.v, Only(enough, mean));
  Store(out->scale.v, per * (1 / step));
}

}  // namespace ambrig
