#include "fdd/residual_chart.h"

#include <algorithm>
#include <cmath>

#include "actuators/lane_vector.h"

namespace ambrig {

namespace {

using V = LaneVector;
constexpr double kFewest = 4;         // samples of a phase that counts
constexpr double kZeroCurrent = 0.03; // [A] below: the diodes may block
constexpr double kNormalSize = 0.8;   // mean of |z| of a normal variable

[[gnu::always_inline]] inline V Abs(const V& a) { return a < 0 ? -a : a; }
[[gnu::always_inline]] inline V Max(const V& a, const V& b) { return a > b ? a : b; }
[[gnu::always_inline]] inline V Min(const V& a, const V& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline V SquareRoot(const V& a) {
  Lane out;
  for (int j = 0; j < kLanes; ++j) out[j] = std::sqrt(a[j]);
  return Load(out.v);
}

struct Terms {
  V n, leakage, own, dP, watched, largest;
  double step = 0, potential_rate = 0;
};

[[gnu::always_inline]] inline void Phase(const Terms& c, const ChartSettings& s, const ModelError& known,
                                         const PhaseSlopes& p, bool off, const Lane& size, Lane* e, Lane* sd, Lane* z,
                                         Lane* valid) {
  const V zero = {}, one = zero + 1, nothing = zero + kZeroCurrent;
  const V di = Load(p.current.v), flux = Load(p.linkage.v) - c.leakage * di;
  const V noise = c.own * s.current_noise, moved = c.n * c.dP * c.potential_rate;
  const V variance = noise * noise * (Load(p.scale.v) / c.step) + known.doubt[0] * di * di -
                     known.doubt[1] * di * flux + known.doubt[2] * flux * flux + s.voltage_sd * s.voltage_sd +
                     moved * moved;
  const V width = SquareRoot(variance) * Min(Max(Load(size.v) / kNormalSize, one), zero + 5);
  const V residual = Load(p.residual.v) + known.leakage * di - known.gap * flux;
  // At zero current the diodes may block: off says nothing, on only that too little flux comes.
  const V least = Load(p.least.v), mean = Load(p.mean.v);
  const V few = Load(p.samples.v) < kFewest ? one : zero, clipped = c.largest < s.adc_limit ? zero : one;
  const V low = mean < 2 * nothing ? (residual > zero ? one : zero) : zero;
  const V blocks = least < nothing ? (off ? one : low) : zero;
  const V ok = few + clipped + blocks > zero ? zero : c.watched;
  Store(e->v, residual);
  Store(sd->v, width);
  Store(z->v, ok > zero ? residual / width : zero);
  Store(valid->v, ok);
}

AMBRIG_WIDE void ComputeAll(const LinkageModel& m, double step, const ChartSettings& s, const ModelError& known,
                            const PeriodSlopes& slopes, const Lane& watched, double potential_rate, ResidualChart* r) {
  const V n = Load(m.n.v), P = Load(slopes.P.v);
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  Terms c;
  c.n = n;
  c.leakage = Load(m.leakage.v);
  c.own = n * n * (radial ? P * (1 - P / slopes.total) : P) + c.leakage;
  c.dP = Load(slopes.dP.v);
  c.watched = Load(watched.v);
  c.largest = Load(slopes.largest.v);
  c.step = step;
  c.potential_rate = potential_rate;
  Phase(c, s, known, slopes.phase[0], false, r->size[0], &r->e[0], &r->sd[0], &r->z[0], &r->valid[0]);
  Phase(c, s, known, slopes.phase[1], true, r->size[1], &r->e[1], &r->sd[1], &r->z[1], &r->valid[1]);
}

AMBRIG_WIDE void Accumulate(const ChartSettings& s, ResidualChart* r) {
  const V zero = {}, cap = zero + s.cap;
  const V on = Load(r->valid[0].v), off = Load(r->valid[1].v), both = on * off;
  const V z[3] = {Load(r->z[0].v), Load(r->z[1].v), (Load(r->z[0].v) - Load(r->z[1].v)) * 0.7071};
  const V counts[3] = {on, off, both};
  for (int q = 0; q < 3; ++q) {
    const V G = Load(r->G[q].v);
    Store(r->G[q].v, counts[q] > zero ? Max(G + Min(Abs(z[q]), cap) - s.drift, zero) : G);
  }
}

AMBRIG_WIDE void StepSizes(const Lane& before, const Lane& after, const Lane& expected, double step, Lane* out) {
  Store(out->v, Abs((Load(after.v) - Load(before.v)) / step - Load(expected.v)));
}

}  // namespace

void ResidualChart::Compute(const LinkageModel& m, const SamplingSettings& sampling, const ChartSettings& s,
                            const ModelError& known, const PeriodSlopes& slopes, const Lane& watched,
                            double potential_rate) {
  ComputeAll(m, sampling.step, s, known, slopes, watched, potential_rate, this);
}

void ResidualChart::Cusum(const ChartSettings& s) { Accumulate(s, this); }

double ResidualChart::LargestSum() const {
  double most = 0;
  for (const Lane& one : G)
    for (double g : one.v) most = g > most ? g : most;
  return most;
}

double LargestStep(const Lane& before, const Lane& after, const Lane& expected, double step) {
  Lane sizes;
  StepSizes(before, after, expected, step, &sizes);
  double most = 0;
  for (double v : sizes.v) most = v > most ? v : most;
  return most;
}

}  // namespace ambrig
