#include "fdd/measurement/slope_fit.h"

#include <cmath>

#include "actuators/electronics/coil_voltage.h"
#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

/// Largest integers not above x, for 0 <= x < 2^51.
template <class V>
[[gnu::always_inline]] inline V Floor(const V& x) {
  constexpr double kRound = 4503599627370496.0;  // 2^52: the sum has no binary places left
  const V nearest = (x + kRound) - kRound;
  return Select(nearest > x, nearest - 1, nearest);
}

/// Of a bridge that only the edge of the duty moves: its period [s] and voltages.
struct PlainBridge {
  const Lane* duty;  // nullptr: edges and voltages are there
  double period, on, off;
};

/// Sample k lies in the on phase when k h <= edge; the edge itself belongs to both.
template <class V>
[[gnu::always_inline]] inline void Count(const PlainBridge& bridge, double step, double samples,
                                         PeriodSlopes* out) {
  const V all = samples, none = 0.0, one = 1.0;
  V edge, on, off;
  if (bridge.duty) {
    edge = LoadAs<V>(bridge.duty->v) * bridge.period;
    on = bridge.on;
    off = bridge.off;
    Store(out->edge.v, edge);
    Store(out->phase[0].voltage.v, on);
    Store(out->phase[1].voltage.v, off);
  } else {
    edge = LoadAs<V>(out->edge.v);
    on = LoadAs<V>(out->phase[0].voltage.v);
    off = LoadAs<V>(out->phase[1].voltage.v);
  }
  const V count = Select(edge > none, Min(Floor(edge * ((1 + 1e-12) / step)) + one, all), none);
  Store(out->phase[0].samples.v, count);
  Store(out->phase[1].samples.v, all - count);
  // share of the time after the last sample
  const V last = Min(Max(edge * (1 / step) - (samples - 1), none), one);
  Store(out->after.v, last * on + (one - last) * off);
}
AMBRIG_WHOLE void CountWhole(const PlainBridge& b, double step, double samples, PeriodSlopes* out) {
  Count<WholeLaneVector>(b, step, samples, out);
}
AMBRIG_WIDE void CountHalves(const PlainBridge& b, double step, double samples, PeriodSlopes* out) {
  Count<LaneVector>(b, step, samples, out);
}

/// Of n samples: n, n² - 1 and n (n² - 1), this one 1 where no slope is to be had.
template <class V>
struct Samples {
  V n, less, product;
  [[gnu::always_inline]] explicit Samples(const V& count)
      : n(count), less(n * n - 1), product(Select(n < 2, 1, n * less)) {}
};

/// `inverse` is 1/(n (n² - 1)).
template <class V>
[[gnu::always_inline]] inline void FitPhase(const Samples<V>& s, const V& inverse, const V& from,
                                            double step, const V& resistance, const V& y,
                                            const V& ky, const V& i, const V& ki,
                                            PhaseSlopes* out) {
  const V middle = 0.5 * (s.n - 1) + from;
  const auto few = s.n < 2;
  const V scale = Select(few, 0.0, inverse * (12 / step));
  const V linkage = (ky - middle * y) * scale, mean = i * Select(few, 1, s.less * inverse);
  Store(out->scale.v, scale);
  Store(out->linkage.v, linkage);
  Store(out->current.v, (ki - middle * i) * scale);
  Store(out->mean.v, mean);
  Store(out->residual.v, linkage + resistance * mean - LoadAs<V>(out->voltage.v));
}

template <class V>
[[gnu::always_inline]] inline void FitPhases(const LinkageModel& m, double step,
                                             PeriodSlopes* out) {
  const SlopeSums& s = out->sums;
  const V y = LoadAs<V>(s.y_on.v), ky = LoadAs<V>(s.ky_on.v), i = LoadAs<V>(s.i_on.v),
          ki = LoadAs<V>(s.ki_on.v), R = LoadAs<V>(m.resistance.v);
  const Samples<V> on(LoadAs<V>(out->phase[0].samples.v)), off(LoadAs<V>(out->phase[1].samples.v));
  const V inverse = 1 / (on.product * off.product);  // one division for both
  FitPhase<V>(on, off.product * inverse, 0.0, step, R, y, ky, i, ki, &out->phase[0]);
  FitPhase<V>(off, on.product * inverse, on.n, step, R, LoadAs<V>(s.y.v) - y,
              LoadAs<V>(s.ky.v) - ky, LoadAs<V>(s.i.v) - i, LoadAs<V>(s.ki.v) - ki, &out->phase[1]);
}
AMBRIG_WHOLE void FitWhole(const LinkageModel& m, double step, PeriodSlopes* out) {
  FitPhases<WholeLaneVector>(m, step, out);
}
AMBRIG_WIDE void FitHalves(const LinkageModel& m, double step, PeriodSlopes* out) {
  FitPhases<LaneVector>(m, step, out);
}

}  // namespace

BridgeVoltage VoltageOf(const AmplifierParameters& p, double duty, double bus) {
  const double T = 1 / p.switching_frequency;
  BridgeVoltage out;
  const CoilVoltage v = IdealBridgeVoltage(p, duty);
  const int first = v.t1 >= T ? 0 : 1;
  out.edge = first == 0 ? T : v.t2;
  out.on = v.gain[first] * bus + v.drop[first];
  out.off = v.gain[2] * bus + v.drop[2];
  return out;
}

double SlopeVariance(double n, double step) {
  return n < 2 ? 1e30 : 12 / (n * (n * n - 1) * step * step);
}

void PreparePeriod(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                   PeriodSlopes* out) {
  const double from[2] = {in.x0, in.y0}, to[2] = {in.x1, in.y1};
  m.Permeance(from, to, &out->permeance);
  const AmplifierParameters& a = *s.amplifier;
  PlainBridge bridge{};
  if (a.modulation == Modulation::kBiState) {  // the usual case: only the edges differ
    const BridgeVoltage v = VoltageOf(a, 0.5, in.bus);
    bridge = {in.duty, 1 / a.switching_frequency, v.on, v.off};
  } else {
    for (int j = 0; j < m.coils; ++j) {
      const BridgeVoltage v = VoltageOf(a, (*in.duty)[j], in.bus);
      out->edge[j] = v.edge;
      out->phase[0].voltage[j] = v.on;
      out->phase[1].voltage[j] = v.off;
    }
  }
  (whole_lanes ? CountWhole : CountHalves)(bridge, s.step, s.samples, out);
}

void FitSlopes(const LinkageModel& m, const SamplingSettings& s, PeriodSlopes* out) {
  (whole_lanes ? FitWhole : FitHalves)(m, s.step, out);
}

}  // namespace ambrig
