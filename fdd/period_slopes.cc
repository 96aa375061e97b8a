#include "fdd/period_slopes.h"

#include "actuators/lane_vector.h"
#include "fdd/slope_fit.h"

namespace ambrig {

namespace {

/// `inverse_sum`: 1/Σ P, radial only.
template <Coupling kCoupling>
[[gnu::always_inline]] inline LaneVector Linkage(const LaneVector& n, const LaneVector& leakage, const LaneVector& P,
                                                 const LaneVector& i, double inverse_sum) {
  const LaneVector mmf = n * i;
  if constexpr (kCoupling == Coupling::kFloatingRotor)
    return n * P * (mmf - Sum(P * mmf) * inverse_sum) + leakage * i;
  else if constexpr (kCoupling == Coupling::kSides)
    return n * P * (mmf + Partner(mmf)) + leakage * i;
  else
    return n * P * mmf + leakage * i;
}

template <Coupling kCoupling>
[[gnu::always_inline]] inline void Accumulate(const LinkageModel& m, const Lane& on_samples, const MovingPermeance& P,
                                              const Lane* adc, int count, SlopeSums* s) {
  const LaneVector n = Load(m.n.v), leakage = Load(m.leakage.v), on_count = Load(on_samples.v);
  const LaneVector p0 = Load(P.start.v), dp = Load(P.change.v) * (1.0 / count);
  const LaneVector zero, far = 1e30;
  LaneVector y_on = zero, ky_on = zero, y = zero, ky = zero, i_on = zero, ki_on = zero, is = zero, ki = zero;
  double inverse_sum[64];
  const double sum0 = Sum(p0), dsum = Sum(dp);
  for (int k = 0; k < count; ++k) inverse_sum[k] = 1 / (sum0 + dsum * k);
  LaneVector least_on = far, least_off = far, largest = -far;
  for (int k = 0; k < count; ++k) {
    const LaneVector at = static_cast<double>(k), i = Load(adc[k].v);
    const LaneVector lambda = Linkage<kCoupling>(n, leakage, p0 + dp * at, i, inverse_sum[k]);
    if (k == 0) Store(s->first.v, lambda);
    if (k == count - 1) Store(s->last.v, lambda);
    const auto on = on_count > at;
    const LaneVector lambda_on = Select(on, lambda, zero), current_on = Select(on, i, zero);
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

AMBRIG_WIDE void AccumulateRadial(const LinkageModel& m, const Lane& on, const MovingPermeance& P,
                                  const Lane* adc, int count, SlopeSums* s) {
  Accumulate<Coupling::kFloatingRotor>(m, on, P, adc, count, s);
}
AMBRIG_WIDE void AccumulateSides(const LinkageModel& m, const Lane& on, const MovingPermeance& P,
                                  const Lane* adc, int count, SlopeSums* s) {
  Accumulate<Coupling::kSides>(m, on, P, adc, count, s);
}
AMBRIG_WIDE void AccumulateSeparate(const LinkageModel& m, const Lane& on, const MovingPermeance& P,
                                  const Lane* adc, int count, SlopeSums* s) {
  Accumulate<Coupling::kNone>(m, on, P, adc, count, s);
}

}  // namespace

void ComputePeriodSlopes(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                         PeriodSlopes* out) {
  SlopeSums sums;
  PreparePeriod(m, s, in, out);
  const auto run = m.coupling == Coupling::kFloatingRotor ? AccumulateRadial
                   : m.coupling == Coupling::kSides       ? AccumulateSides
                                                          : AccumulateSeparate;
  run(m, out->phase[0].samples, out->permeance, in.adc, s.samples, &sums);
  FitSlopes(m, s, sums, out);
}

}  // namespace ambrig
