#include "fdd/measurement/period_slopes.h"

#include "actuators/magnetics/first_lanes.h"
#include "fdd/measurement/slope_fit.h"

namespace ambrig {

namespace {

/// Sums over the samples. Of k x_k they come from sums of sums: Σ (N - k) x_k adds up what Σ x is
/// after each of N samples, which needs no product.
template <class V>
struct Sums {
  V x, of_sums;
  [[gnu::always_inline]] void Add(const V& value) {
    x += value;
    of_sums += x;
  }
  template <class Mask>
  [[gnu::always_inline]] void AddWhere(const Mask& on, const V& value) {
    x += Select(on, value, 0.0);
    of_sums += x;
  }
  [[gnu::always_inline]] V Weighted(int count) const {
    return x * static_cast<double>(count) - of_sums;
  }
};

/// Least samples of each phase. Where none is near zero, as usual, the least of both does for
/// either: it is asked only whether the diodes may block.
template <class V>
[[gnu::always_inline]] inline void LeastOfPhases(const Lane* adc, int count, const V& least,
                                                 PeriodSlopes* out) {
  const V far = 1e30, zero;
  V on_phase = least, off_phase = least;
  if (-Largest(-least) < kZeroCurrent) {
    on_phase = off_phase = far;
    V left = LoadAs<V>(out->phase[0].samples.v);
    for (int k = 0; k < count; ++k, left = left - 1) {
      const V i = LoadAs<V>(adc[k].v);
      const auto on = left > zero;
      on_phase = Min(Select(on, i, far), on_phase);
      off_phase = Min(Select(on, far, i), off_phase);
    }
  }
  Store(out->phase[0].least.v, on_phase);
  Store(out->phase[1].least.v, off_phase);
}

/// Linkages λ = (n² P + L_l) i - n P U; U is the rotor's potential Σ P n i / Σ P (radial), the
/// partner's share of a common core, -n i' (thrust), or none.
template <class V, Coupling kCoupling>
[[gnu::always_inline]] inline void Accumulate(const LinkageModel& m, const Lane* adc, int count,
                                              PeriodSlopes* out) {
  const MovingPermeance& P = out->permeance;
  SlopeSums* s = &out->sums;
  const V n = LoadAs<V>(m.n.v), per = 1.0 / count, zero, far = 1e30;
  V turns_P = n * LoadAs<V>(P.start.v), own = n * turns_P + LoadAs<V>(m.leakage.v),
    left = LoadAs<V>(out->phase[0].samples.v);
  const V turns_P_grows = n * LoadAs<V>(P.change.v) * per, own_grows = n * turns_P_grows;
  double inverse_sum[64];
  const double sum0 = Sum(LoadAs<V>(P.start.v)), dsum = Sum(LoadAs<V>(P.change.v)) / count;
  for (int k = 0; k < count; ++k) inverse_sum[k] = 1 / (sum0 + dsum * k);
  Sums<V> y, i_all, y_on, i_on;
  V lambda, least = far, largest = -far;
  for (int k = 0; k < count; ++k) {
    const V i = LoadAs<V>(adc[k].v);
    if constexpr (kCoupling == Coupling::kFloatingRotor)
      lambda = own * i - turns_P * (Sum(turns_P * i) * inverse_sum[k]);
    else if constexpr (kCoupling == Coupling::kSides)
      lambda = own * i + turns_P * Partner(n * i);
    else
      lambda = own * i;
    if (k == 0) Store(out->first.v, lambda);
    turns_P += turns_P_grows;
    own += own_grows;
    const auto on = left > zero;
    left = left - 1;
    y.Add(lambda);
    i_all.Add(i);
    y_on.AddWhere(on, lambda);
    i_on.AddWhere(on, i);
    least = Min(i, least);
    largest = Max(i, largest);
  }
  Store(out->last.v, lambda);
  Store(s->y_on.v, y_on.x);
  Store(s->ky_on.v, y_on.Weighted(count));
  Store(s->y.v, y.x);
  Store(s->ky.v, y.Weighted(count));
  Store(s->i_on.v, i_on.x);
  Store(s->ki_on.v, i_on.Weighted(count));
  Store(s->i.v, i_all.x);
  Store(s->ki.v, i_all.Weighted(count));
  Store(out->largest.v, largest);
  LeastOfPhases(adc, count, Select(n == zero, far, least), out);
}

AMBRIG_WHOLE void RadialWhole(const LinkageModel& m, const Lane* adc, int count,
                              PeriodSlopes* out) {
  Accumulate<WholeLaneVector, Coupling::kFloatingRotor>(m, adc, count, out);
}
AMBRIG_WIDE void RadialHalves(const LinkageModel& m, const Lane* adc, int count,
                              PeriodSlopes* out) {
  Accumulate<LaneVector, Coupling::kFloatingRotor>(m, adc, count, out);
}
AMBRIG_WHOLE void SidesWhole(const LinkageModel& m, const Lane* adc, int count, PeriodSlopes* out) {
  Accumulate<WholeLaneVector, Coupling::kSides>(m, adc, count, out);
}
AMBRIG_WIDE void SidesHalves(const LinkageModel& m, const Lane* adc, int count, PeriodSlopes* out) {
  Accumulate<FirstLanes, Coupling::kSides>(m, adc, count, out);
}
AMBRIG_WIDE void Separate(const LinkageModel& m, const Lane* adc, int count, PeriodSlopes* out) {
  Accumulate<LaneVector, Coupling::kNone>(m, adc, count, out);
}

}  // namespace

void ComputePeriodSlopes(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                         PeriodSlopes* out) {
  PreparePeriod(m, s, in, out);
  const auto run = m.coupling == Coupling::kFloatingRotor
                       ? (whole_lanes ? RadialWhole : RadialHalves)
                   : m.coupling == Coupling::kSides ? (whole_lanes ? SidesWhole : SidesHalves)
                                                    : Separate;
  run(m, in.adc, s.samples, out);
  FitSlopes(m, s, out);
}

}  // namespace ambrig
