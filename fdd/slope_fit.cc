#include "fdd/slope_fit.h"

#include <cmath>

#include "actuators/lane_vector.h"

namespace ambrig {

namespace {

using V = LaneVector;

/// Largest integers not above x, for 0 <= x < 2^51.
[[gnu::always_inline]] inline V Floor(const V& x) {
  constexpr double kRound = 4503599627370496.0;  // 2^52: the sum has no binary places left
  const V nearest = (x + kRound) - kRound;
  return Select(nearest > x, nearest - 1, nearest);
}

/// Sample k lies in the on phase when k h <= edge; the edge itself belongs to both.
AMBRIG_WIDE void CountSamples(double step, double samples, PeriodSlopes* out) {
  const V all = samples, edge = Load(out->edge.v);
  V count = Floor(edge * ((1 + 1e-12) / step)) + 1;
  count = Select(edge > 0.0, Min(count, all), 0.0);
  Store(out->phase[0].samples.v, count);
  Store(out->phase[1].samples.v, all - count);
  V last = (edge - (samples - 1) * step) / step;  // share of the time after the last sample
  last = Min(Max(last, 0.0), 1.0);
  Store(out->after.v, last * Load(out->phase[0].voltage.v) + (1 - last) * Load(out->phase[1].voltage.v));
}

AMBRIG_WIDE void EdgesOf(const Lane& duty, double T, const BridgeVoltage& v, PeriodSlopes* out) {
  Store(out->edge.v, Load(duty.v) * T);
  Store(out->phase[0].voltage.v, V(v.on));
  Store(out->phase[1].voltage.v, V(v.off));
}

[[gnu::always_inline]] inline void Fit(const V& n, const V& from, double step, const V& resistance, const V& y, const V& ky,
                                       const V& i, const V& ki, PhaseSlopes* out) {
  const V middle = 0.5 * (n - 1) + from;
  const V scale = Select(n < 2, 0.0, 12 / (n * (n * n - 1) * step));
  const V linkage = (ky - middle * y) * scale, mean = Select(n > 0.0, i / n, 0.0);
  Store(out->scale.v, scale);
  Store(out->linkage.v, linkage);
  Store(out->current.v, (ki - middle * i) * scale);
  Store(out->mean.v, mean);
  Store(out->residual.v, linkage + resistance * mean - Load(out->voltage.v));
}

AMBRIG_WIDE void FitBoth(const LinkageModel& m, double step, const SlopeSums& s, PeriodSlopes* out) {
  const V y = Load(s.y_on.v), ky = Load(s.ky_on.v), i = Load(s.i_on.v), ki = Load(s.ki_on.v), R = Load(m.resistance.v);
  const V on = Load(out->phase[0].samples.v), off = Load(out->phase[1].samples.v);
  Fit(on, V{}, step, R, y, ky, i, ki, &out->phase[0]);
  Fit(off, on, step, R, Load(s.y.v) - y, Load(s.ky.v) - ky, Load(s.i.v) - i, Load(s.ki.v) - ki, &out->phase[1]);
}

}  // namespace

BridgeVoltage VoltageOf(const AmplifierParameters& p, double duty, double bus) {
  const double T = 1 / p.switching_frequency;
  BridgeVoltage out;
  const CoilVoltage v = PowerAmplifier(p).Pattern(duty, {});
  const int first = v.t1 >= T ? 0 : 1;
  out.edge = first == 0 ? T : v.t2;
  out.on = v.gain[first] * bus + v.drop[first];
  out.off = v.gain[2] * bus + v.drop[2];
  return out;
}

double SlopeVariance(double n, double step) { return n < 2 ? 1e30 : 12 / (n * (n * n - 1) * step * step); }

void PreparePeriod(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in, PeriodSlopes* out) {
  const double from[2] = {in.x0, in.y0}, to[2] = {in.x1, in.y1};
  m.Permeance(from, to, &out->permeance);
  const AmplifierParameters& a = *s.amplifier;
  if (a.modulation == Modulation::kBiState) {  // the usual case: only the edges differ
    EdgesOf(*in.duty, 1 / a.switching_frequency, VoltageOf(a, 0.5, in.bus), out);
  } else {
    for (int j = 0; j < m.coils; ++j) {
      const BridgeVoltage v = VoltageOf(a, (*in.duty)[j], in.bus);
      out->edge[j] = v.edge;
      out->phase[0].voltage[j] = v.on;
      out->phase[1].voltage[j] = v.off;
    }
  }
  CountSamples(s.step, s.samples, out);
}

void FitSlopes(const LinkageModel& m, const SamplingSettings& s, const SlopeSums& sums, PeriodSlopes* out) {
  out->largest = sums.largest;
  out->first = sums.first;
  out->last = sums.last;
  out->phase[0].least = sums.least_on;
  out->phase[1].least = sums.least_off;
  FitBoth(m, s.step, sums, out);
}

}  // namespace ambrig
