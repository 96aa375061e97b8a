#include "fdd/measurement/residual_chart.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr double kNormalSize = 0.8;  // mean of |z| of a normal variable

/// 1/sqrt a of positive lanes. Halving the exponent starts Newton's iteration within 3.5 %, which
/// becomes 2e-3, then 5e-6 (error -> 3/2 error²): enough for the size of noise, a third of the
/// processor's own root.
template <class Lanes, class Bits>
[[gnu::always_inline]] inline Lanes NewtonRoot(const Lanes& a) {
  const Lanes half = 0.5 * a;
  auto y = (Lanes)(0x5fe6eb50c7b537a9LL - ((Bits)a >> 1));
  for (int iteration = 0; iteration < 2; ++iteration) y = y * (1.5 - half * y * y);
  return y;
}
[[gnu::always_inline]] inline LaneVector InverseRoot(const LaneVector& a) {
  return {NewtonRoot<FourLanes, FourMasks>(a.a), NewtonRoot<FourLanes, FourMasks>(a.b)};
}
[[gnu::always_inline]] inline WholeLaneVector InverseRoot(const WholeLaneVector& a) {
  return NewtonRoot<EightLanes, EightMasks>(a.v);
}

template <class V>
struct Terms {
  V leakage, noise, moved, watched, largest;  // noise, moved: squared [V²]
  double per_step = 0;
};

template <class V>
[[gnu::always_inline]] inline void Phase(const Terms<V>& c, const ChartSettings& s,
                                         const ModelError& known, const PhaseSlopes& p, int q,
                                         const Lane* uncertainty, ResidualChart* r) {
  const V zero = 0.0, one = 1, nothing = kZeroCurrent;
  const V di = LoadAs<V>(p.current.v), flux = LoadAs<V>(p.linkage.v) - c.leakage * di;
  const V uncertain = uncertainty ? LoadAs<V>(uncertainty[q].v) : zero;
  const V variance = c.noise * (LoadAs<V>(p.scale.v) * c.per_step) +
                     di * (di * known.uncertainty[0] - flux * known.uncertainty[1]) +
                     flux * flux * known.uncertainty[2] + c.moved + uncertain * uncertain;
  const V wider = Min(Max(LoadAs<V>(r->size[q].v) * (1 / kNormalSize), one), 5),
          total = variance * (wider * wider);
  const V inverse_width = InverseRoot(total);
  const V residual = LoadAs<V>(p.residual.v) + di * known.leakage - flux * known.gap;
  // At zero current the diodes may block: off says nothing, on only that too little flux comes.
  const V least = LoadAs<V>(p.least.v), mean = LoadAs<V>(p.mean.v);
  V blocks = one;
  if (q == 0) blocks = Select(mean < nothing + nothing, Select(residual > zero, one, zero), zero);
  V ok = Select(least < nothing, one - blocks, one) * c.watched;
  ok = Select(LoadAs<V>(p.samples.v) < kFewestSamples, zero, ok);
  ok = Select(c.largest < s.adc_limit, ok, zero);
  Store(r->e[q].v, residual);
  Store(r->sd[q].v, total * inverse_width);
  Store(r->per_sd[q].v, inverse_width);
  Store(r->z[q].v, Select(ok > zero, residual * inverse_width, zero));
  Store(r->valid[q].v, ok);
}

struct Circumstance {
  const Lane* watched;
  const Lane* uncertainty;
  double step, potential_rate;
};

template <class V>
[[gnu::always_inline]] inline void ComputeAll(const LinkageModel& m, const Circumstance& at,
                                              const ChartSettings& s, const ModelError& known,
                                              const PeriodSlopes& slopes, ResidualChart* r) {
  const V n = LoadAs<V>(m.n.v), P = LoadAs<V>(slopes.permeance.middle.v);
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  Terms<V> c;
  c.leakage = LoadAs<V>(m.leakage.v);
  const V own = n * n * (radial ? P * (1 - P * (1 / slopes.permeance.total)) : P) + c.leakage;
  Store(r->own.v, own);
  const V noise = own * s.current_noise,
          moved = n * LoadAs<V>(slopes.permeance.change.v) * at.potential_rate;
  c.noise = noise * noise;
  c.moved = moved * moved + s.voltage_sd * s.voltage_sd;
  c.watched = LoadAs<V>(at.watched->v);
  c.largest = LoadAs<V>(slopes.largest.v);
  c.per_step = 1 / at.step;
  Phase(c, s, known, slopes.phase[0], 0, at.uncertainty, r);
  Phase(c, s, known, slopes.phase[1], 1, at.uncertainty, r);
}
AMBRIG_WHOLE void ChartOfWholeLanes(const LinkageModel& m, const Circumstance& at,
                                    const ChartSettings& s, const ModelError& known,
                                    const PeriodSlopes& slopes, ResidualChart* r) {
  ComputeAll<WholeLaneVector>(m, at, s, known, slopes, r);
}
AMBRIG_WIDE void ChartOfHalfLanes(const LinkageModel& m, const Circumstance& at,
                                  const ChartSettings& s, const ModelError& known,
                                  const PeriodSlopes& slopes, ResidualChart* r) {
  ComputeAll<LaneVector>(m, at, s, known, slopes, r);
}

template <class V>
[[gnu::always_inline]] inline double AccumulateChart(const ChartSettings& s, ResidualChart* r) {
  const V zero = 0.0, cap = s.cap;
  const V on = LoadAs<V>(r->valid[0].v), off = LoadAs<V>(r->valid[1].v), both = on * off;
  const V z[3] = {LoadAs<V>(r->z[0].v), LoadAs<V>(r->z[1].v),
                  (LoadAs<V>(r->z[0].v) - LoadAs<V>(r->z[1].v)) * 0.7071};
  const V counts[3] = {on, off, both};
  V most = zero;
  for (int q = 0; q < 3; ++q) {
    const V before = LoadAs<V>(r->G[q].v);
    const V G =
        Select(counts[q] > zero, Max(before + Min(Max(z[q], -z[q]), cap) - s.drift, zero), before);
    Store(r->G[q].v, G);
    most = Max(most, G);
  }
  return Largest(most);
}
AMBRIG_WHOLE double AccumulateWhole(const ChartSettings& s, ResidualChart* r) {
  return AccumulateChart<WholeLaneVector>(s, r);
}
AMBRIG_WIDE double AccumulateHalves(const ChartSettings& s, ResidualChart* r) {
  return AccumulateChart<LaneVector>(s, r);
}

AMBRIG_WIDE double BeyondNoise(const Lane& own, const LinkageStep& step, double limit) {
  const LaneVector jump =
      Abs((Load(step.after->v) - Load(step.before->v)) * step.per_second - Load(step.expected->v));
  return Largest(jump - limit * (step.noise * Load(own.v) + step.floor));
}

}  // namespace

void ResidualChart::Compute(const LinkageModel& m, const SamplingSettings& sampling,
                            const ChartSettings& s, const ModelError& known,
                            const PeriodSlopes& slopes, const Lane& watched,
                            const Lane* uncertainty, double potential_rate) {
  (whole_lanes ? ChartOfWholeLanes : ChartOfHalfLanes)(
      m, {&watched, uncertainty, sampling.step, potential_rate}, s, known, slopes, this);
}

double ResidualChart::Cusum(const ChartSettings& s) {
  return (whole_lanes ? AccumulateWhole : AccumulateHalves)(s, this);
}

double ResidualChart::LargestSum() const {
  double most = 0;
  for (const Lane& one : G) most = std::max(most, *std::max_element(one.v, one.v + kLanes));
  return most;
}

double ResidualChart::LargestResidual() const {
  double most = 0;
  for (const Lane& one : z)
    for (double v : one.v) most = std::max(most, std::abs(v));
  return most;
}

bool ResidualChart::Steps(const LinkageStep& step, double limit) const {
  return BeyondNoise(own, step, 0.999 * limit) > 0;
}

}  // namespace ambrig
