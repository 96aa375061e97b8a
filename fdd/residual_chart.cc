#include "fdd/residual_chart.h"

#include <algorithm>
#include <cmath>

#include "actuators/lane_vector.h"

namespace ambrig {

namespace {

using V = LaneVector;
constexpr double kNormalSize = 0.8;   // mean of |z| of a normal variable

/// 1/sqrt a of four positive lanes. Halving the exponent starts Newton's iteration within 3.5 %, which becomes
/// 2e-3, 5e-6, 4e-11 (error -> 3/2 error²): the processor's own root takes three times as long.
[[gnu::always_inline]] inline FourLanes InverseRoot(const FourLanes& a) {
  const FourLanes half = 0.5 * a;
  auto y = (FourLanes)(0x5fe6eb50c7b537a9LL - ((FourMasks)a >> 1));
  for (int iteration = 0; iteration < 3; ++iteration) y = y * (1.5 - half * y * y);
  return y;
}
[[gnu::always_inline]] inline V InverseRoot(const V& a) { return {InverseRoot(a.a), InverseRoot(a.b)}; }

struct Terms {
  V n, leakage, own, dP, watched, largest;
  double per_step = 0, potential_rate = 0;
};

[[gnu::always_inline]] inline void Phase(const Terms& c, const ChartSettings& s, const ModelError& known,
                                         const PhaseSlopes& p, bool off, const Lane& size, const Lane* doubt, Lane* e, Lane* sd, Lane* per_sd, Lane* z,
                                         Lane* valid) {
  const V zero, one = 1, nothing = kZeroCurrent;
  const V di = Load(p.current.v), flux = Load(p.linkage.v) - c.leakage * di;
  const V noise = c.own * s.current_noise, moved = c.n * c.dP * c.potential_rate;
  const V uncertain = doubt ? Load(doubt->v) : zero;
  const V variance = noise * noise * (Load(p.scale.v) * c.per_step) + known.doubt[0] * di * di -
                     known.doubt[1] * di * flux + known.doubt[2] * flux * flux + s.voltage_sd * s.voltage_sd +
                     moved * moved + uncertain * uncertain;
  const V wider = Min(Max(Load(size.v) * (1 / kNormalSize), one), 5), total = variance * (wider * wider);
  const V inverse_width = InverseRoot(total);
  const V residual = Load(p.residual.v) + known.leakage * di - known.gap * flux;
  // At zero current the diodes may block: off says nothing, on only that too little flux comes.
  const V least = Load(p.least.v), mean = Load(p.mean.v);
  const V few = Select(Load(p.samples.v) < kFewestSamples, one, zero), clipped = Select(c.largest < s.adc_limit, zero, one);
  const V low = Select(mean < 2 * nothing, Select(residual > zero, one, zero), zero);
  const V blocks = Select(least < nothing, off ? one : low, zero);
  const V ok = Select(few + clipped + blocks > zero, zero, c.watched);
  Store(e->v, residual);
  Store(sd->v, total * inverse_width);
  Store(per_sd->v, inverse_width);
  Store(z->v, Select(ok > zero, residual * inverse_width, zero));
  Store(valid->v, ok);
}

AMBRIG_WIDE void ComputeAll(const LinkageModel& m, double step, const ChartSettings& s, const ModelError& known,
                            const PeriodSlopes& slopes, const Lane& watched, const Lane* doubt, double potential_rate,
                            ResidualChart* r) {
  const V n = Load(m.n.v), P = Load(slopes.permeance.middle.v);
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  Terms c;
  c.n = n;
  c.leakage = Load(m.leakage.v);
  c.own = n * n * (radial ? P * (1 - P * (1 / slopes.permeance.total)) : P) + c.leakage;
  Store(r->own.v, c.own);
  c.dP = Load(slopes.permeance.change.v);
  c.watched = Load(watched.v);
  c.largest = Load(slopes.largest.v);
  c.per_step = 1 / step;
  c.potential_rate = potential_rate;
  Phase(c, s, known, slopes.phase[0], false, r->size[0], doubt, &r->e[0], &r->sd[0], &r->per_sd[0], &r->z[0], &r->valid[0]);
  Phase(c, s, known, slopes.phase[1], true, r->size[1], doubt ? doubt + 1 : nullptr, &r->e[1], &r->sd[1], &r->per_sd[1], &r->z[1], &r->valid[1]);
}

AMBRIG_WIDE double Accumulate(const ChartSettings& s, ResidualChart* r) {
  const V zero, cap = s.cap;
  const V on = Load(r->valid[0].v), off = Load(r->valid[1].v), both = on * off;
  const V z[3] = {Load(r->z[0].v), Load(r->z[1].v), (Load(r->z[0].v) - Load(r->z[1].v)) * 0.7071};
  const V counts[3] = {on, off, both};
  V most = zero;
  for (int q = 0; q < 3; ++q) {
    const V before = Load(r->G[q].v), G = Select(counts[q] > zero, Max(before + Min(Abs(z[q]), cap) - s.drift, zero), before);
    Store(r->G[q].v, G);
    most = Max(most, G);
  }
  return Largest(most);
}

AMBRIG_WIDE double BeyondNoise(const Lane& own, const LinkageStep& step, double limit) {
  const V jump = Abs((Load(step.after->v) - Load(step.before->v)) * step.per_second - Load(step.expected->v));
  return Largest(jump - limit * (step.noise * Load(own.v) + step.floor));
}

}  // namespace

void ResidualChart::Compute(const LinkageModel& m, const SamplingSettings& sampling, const ChartSettings& s,
                            const ModelError& known, const PeriodSlopes& slopes, const Lane& watched,
                            const Lane* doubt, double potential_rate) {
  ComputeAll(m, sampling.step, s, known, slopes, watched, doubt, potential_rate, this);
}

double ResidualChart::Cusum(const ChartSettings& s) { return Accumulate(s, this); }

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

bool ResidualChart::Steps(const LinkageStep& step, double limit) const { return BeyondNoise(own, step, 0.999 * limit) > 0; }

}  // namespace ambrig
