#include "fdd/period_slopes.h"

#include "actuators/whole_lane_vector.h"
#include "fdd/slope_fit.h"

namespace ambrig {

namespace {

/// `inverse_sum`: 1/Σ P, radial only.
template <class V, Coupling kCoupling>
[[gnu::always_inline]] inline V Linkage(const V& n, const V& leakage, const V& P,
                                                 const V& i, double inverse_sum) {
  const V mmf = n * i;
  if constexpr (kCoupling == Coupling::kFloatingRotor)
    return n * P * (mmf - Sum(P * mmf) * inverse_sum) + leakage * i;
  else if constexpr (kCoupling == Coupling::kSides)
    return n * P * (mmf + Partner(mmf)) + leakage * i;
  else
    return n * P * mmf + leakage * i;
}

template <class V, Coupling kCoupling>
[[gnu::always_inline]] inline void Accumulate(const LinkageModel& m, const Lane& on_samples, const MovingPermeance& P,
                                              const Lane* adc, int count, SlopeSums* s) {
  const V n = LoadAs<V>(m.n.v), leakage = LoadAs<V>(m.leakage.v), on_count = LoadAs<V>(on_samples.v);
  const V p0 = LoadAs<V>(P.start.v), dp = LoadAs<V>(P.change.v) * (1.0 / count);
  const V zero, far = 1e30;
  V y_on = zero, ky_on = zero, y = zero, ky = zero, i_on = zero, ki_on = zero, is = zero, ki = zero;
  double inverse_sum[64];
  const double sum0 = Sum(p0), dsum = Sum(dp);
  for (int k = 0; k < count; ++k) inverse_sum[k] = 1 / (sum0 + dsum * k);
  V least_on = far, least_off = far, largest = -far;
  for (int k = 0; k < count; ++k) {
    const V at = static_cast<double>(k), i = LoadAs<V>(adc[k].v);
    const V lambda = Linkage<V, kCoupling>(n, leakage, p0 + dp * at, i, inverse_sum[k]);
    if (k == 0) Store(s->first.v, lambda);
    if (k == count - 1) Store(s->last.v, lambda);
    const auto on = on_count > at;
    const V lambda_on = Select(on, lambda, zero), current_on = Select(on, i, zero);
    y += lambda;
    ky += at * lambda;
    is += i;
    ki += at * i;
    y_on += lambda_on;
    ky_on += at * lambda_on;
    i_on += current_on;
    ki_on += at * current_on;
    least_on = Min(Select(on, i, far), least_on);
    least_off = Min(Select(on, far, i), least_off);
    largest = Max(i, largest);
  }
  Store(s->y_on.v, y_on);
  Store(s->ky_on.v, ky_on);
  Store(s->y.v, y);
  Store(s->ky.v, ky);
  Store(s->i_on.v, i_on);
  Store(s->ki_on.v, ki_on);
  Store(s->i.v, is);
  Store(s->ki.v, ki);
  Store(s->least_on.v, least_on);
  Store(s->least_off.v, least_off);
  Store(s->largest.v, largest);
}

AMBRIG_WHOLE void RadialWhole(const LinkageModel& m, const Lane& on, const MovingPermeance& P, const Lane* adc, int count, SlopeSums* s) {
  Accumulate<WholeLaneVector, Coupling::kFloatingRotor>(m, on, P, adc, count, s);
}
AMBRIG_WIDE void RadialHalves(const LinkageModel& m, const Lane& on, const MovingPermeance& P, const Lane* adc, int count, SlopeSums* s) {
  Accumulate<LaneVector, Coupling::kFloatingRotor>(m, on, P, adc, count, s);
}
AMBRIG_WHOLE void SidesWhole(const LinkageModel& m, const Lane& on, const MovingPermeance& P, const Lane* adc, int count, SlopeSums* s) {
  Accumulate<WholeLaneVector, Coupling::kSides>(m, on, P, adc, count, s);
}
AMBRIG_WIDE void SidesHalves(const LinkageModel& m, const Lane& on, const MovingPermeance& P, const Lane* adc, int count, SlopeSums* s) {
  Accumulate<LaneVector, Coupling::kSides>(m, on, P, adc, count, s);
}
AMBRIG_WIDE void Separate(const LinkageModel& m, const Lane& on, const MovingPermeance& P, const Lane* adc, int count, SlopeSums* s) {
  Accumulate<LaneVector, Coupling::kNone>(m, on, P, adc, count, s);
}

}  // namespace

void ComputePeriodSlopes(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                         PeriodSlopes* out) {
  SlopeSums sums;
  PreparePeriod(m, s, in, out);
  const auto run = m.coupling == Coupling::kFloatingRotor ? (whole_lanes ? RadialWhole : RadialHalves)
                   : m.coupling == Coupling::kSides       ? (whole_lanes ? SidesWhole : SidesHalves)
                                                          : Separate;
  run(m, out->phase[0].samples, out->permeance, in.adc, s.samples, &sums);
  FitSlopes(m, s, sums, out);
}

}  // namespace ambrig
