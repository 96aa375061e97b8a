#include "fdd/period_slopes.h"

#include <algorithm>
#include <cmath>

#include "actuators/lane_vector.h"

namespace ambrig {

namespace {

/// Sums over the samples k of both phases.
struct Sums {
  Lane y_on, ky_on, y, ky;  // linkage: on phase, whole period
  Lane i_on, ki_on, i, ki;  // current
  Lane least_on, least_off, largest;
  Lane first, last;  // linkage
};

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
[[gnu::always_inline]] inline void Accumulate(const LinkageModel& m, const Lane& on_samples, const Lane& P0,
                                              const Lane& P1, const Lane* adc, int count, Sums* s) {
  const LaneVector n = Load(m.n.v), leakage = Load(m.leakage.v), on_count = Load(on_samples.v);
  const LaneVector p0 = Load(P0.v), dp = (Load(P1.v) - p0) / (0.0 * p0 + count);
  const LaneVector zero = {}, far = zero + 1e30;
  LaneVector y_on = zero, ky_on = zero, y = zero, ky = zero, i_on = zero, ki_on = zero, is = zero, ki = zero;
  double inverse_sum[64];
  const double sum0 = Sum(p0), dsum = Sum(dp);
  for (int k = 0; k < count; ++k) inverse_sum[k] = 1 / (sum0 + dsum * k);
  LaneVector least_on = far, least_off = far, largest = -far;
  for (int k = 0; k < count; ++k) {
    const LaneVector at = zero + static_cast<double>(k), i = Load(adc[k].v);
    const LaneVector lambda = Linkage<kCoupling>(n, leakage, p0 + dp * at, i, inverse_sum[k]);
    if (k == 0) Store(s->first.v, lambda);
    if (k == count - 1) Store(s->last.v, lambda);
    const auto on = on_count > at;
    const LaneVector lambda_on = on ? lambda : zero, current_on = on ? i : zero;
    y += lambda;
    ky += at * lambda;
    is += i;
    ki += at * i;
    y_on += lambda_on;
    ky_on += at * lambda_on;
    i_on += current_on;
    ki_on += at * current_on;
    const LaneVector in_on = on ? i : far, in_off = on ? far : i;
    least_on = in_on < least_on ? in_on : least_on;
    least_off = in_off < least_off ? in_off : least_off;
    largest = i > largest ? i : largest;
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

AMBRIG_WIDE void AccumulateRadial(const LinkageModel& m, const Lane& on, const Lane& P0, const Lane& P1,
                                  const Lane* adc, int count, Sums* s) {
  Accumulate<Coupling::kFloatingRotor>(m, on, P0, P1, adc, count, s);
}
AMBRIG_WIDE void AccumulateSides(const LinkageModel& m, const Lane& on, const Lane& P0, const Lane& P1,
                                 const Lane* adc, int count, Sums* s) {
  Accumulate<Coupling::kSides>(m, on, P0, P1, adc, count, s);
}
AMBRIG_WIDE void AccumulateSeparate(const LinkageModel& m, const Lane& on, const Lane& P0, const Lane& P1,
                                    const Lane* adc, int count, Sums* s) {
  Accumulate<Coupling::kNone>(m, on, P0, P1, adc, count, s);
}

void Bridges(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in, PeriodSlopes* out) {
  PhaseSlopes &on = out->phase[0], &off = out->phase[1];
  const double per_step = (1 + 1e-12) / s.step;
  for (int j = 0; j < m.coils; ++j) {
    const BridgeVoltage v = VoltageOf(*s.amplifier, (*in.duty)[j], in.bus);
    // Sample k lies in the on phase when k h <= edge; the edge itself belongs to both.
    const double count = v.edge <= 0 ? 0 : std::min(static_cast<int>(v.edge * per_step) + 1, s.samples);
    on.samples[j] = count;
    off.samples[j] = s.samples - count;
    out->edge[j] = v.edge;
    on.voltage[j] = v.on;
    off.voltage[j] = v.off;
  }
}

/// Per lane of one phase: 1/n, middle index and 12/(n (n²-1) h), 0 below two samples.
struct Regression {
  Lane inverse_n, middle, scale;
};

[[gnu::always_inline]] inline void Fit(const Regression& r, const Lane& resistance, const LaneVector& y,
                                       const LaneVector& ky, const LaneVector& i, const LaneVector& ki,
                                       PhaseSlopes* out) {
  const LaneVector middle = Load(r.middle.v), scale = Load(r.scale.v);
  const LaneVector linkage = (ky - middle * y) * scale, mean = i * Load(r.inverse_n.v);
  Store(out->linkage.v, linkage);
  Store(out->current.v, (ki - middle * i) * scale);
  Store(out->mean.v, mean);
  Store(out->residual.v, linkage + Load(resistance.v) * mean - Load(out->voltage.v));
}

AMBRIG_WIDE void FitBoth(const LinkageModel& m, const Regression* r, const Sums& s, PeriodSlopes* out) {
  const LaneVector y = Load(s.y_on.v), ky = Load(s.ky_on.v), i = Load(s.i_on.v), ki = Load(s.ki_on.v);
  Fit(r[0], m.resistance, y, ky, i, ki, &out->phase[0]);
  Fit(r[1], m.resistance, Load(s.y.v) - y, Load(s.ky.v) - ky, Load(s.i.v) - i, Load(s.ki.v) - ki, &out->phase[1]);
}

void Finish(const LinkageModel& m, const SamplingSettings& s, const Sums& sum, PeriodSlopes* out) {
  Regression r[2];
  out->largest = sum.largest;
  out->first = sum.first;
  out->last = sum.last;
  out->phase[0].least = sum.least_on;
  out->phase[1].least = sum.least_off;
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < m.coils; ++j) {
      const double n = out->phase[q].samples[j];
      r[q].inverse_n[j] = n > 0 ? 1 / n : 0;
      r[q].scale[j] = n < 2 ? 0 : 12 / (n * (n * n - 1) * s.step);
      r[q].middle[j] = 0.5 * (n - 1) + (q == 0 ? 0 : out->phase[0].samples[j]);
    }
  FitBoth(m, r, sum, out);
}

/// Permeances at both ends, mean and sum for the middle.
void Ends(const LinkageModel& m, const MeasuredPeriod& in, PeriodSlopes* out, Lane* P0, Lane* P1) {
  *P0 = m.Permeance(in.x0, in.y0);
  *P1 = m.Permeance(in.x1, in.y1);
  out->total = 0;
  for (int j = 0; j < kLanes; ++j) {
    out->P[j] = 0.5 * (P0->v[j] + P1->v[j]);
    out->dP[j] = P1->v[j] - P0->v[j];
    out->total += out->P[j];
  }
}

}  // namespace

BridgeVoltage VoltageOf(const AmplifierParameters& p, double duty, double bus) {
  const double T = 1 / p.switching_frequency;
  BridgeVoltage out;
  if (p.modulation == Modulation::kBiState) {  // the usual case, without the detour below
    out.edge = duty * T;
    out.on = bus - 2 * p.switch_drop;
    out.off = -bus + (p.quadrants < 3 ? -2 * p.diode_drop : 2 * p.switch_drop);
    return out;
  }
  const CoilVoltage v = PowerAmplifier(p).Pattern(duty, {});
  const int first = v.t1 >= T ? 0 : 1;
  out.edge = first == 0 ? T : v.t2;
  out.on = v.gain[first] * bus + v.drop[first];
  out.off = v.gain[2] * bus + v.drop[2];
  return out;
}

double SlopeVariance(double n, double step) { return n < 2 ? 1e30 : 12 / (n * (n * n - 1) * step * step); }

void ComputePeriodSlopes(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                         PeriodSlopes* out) {
  Lane P0, P1;
  Sums sums;
  Ends(m, in, out, &P0, &P1);
  Bridges(m, s, in, out);
  const auto run = m.coupling == Coupling::kFloatingRotor ? AccumulateRadial
                   : m.coupling == Coupling::kSides       ? AccumulateSides
                                                          : AccumulateSeparate;
  run(m, out->phase[0].samples, P0, P1, in.adc, s.samples, &sums);
  Finish(m, s, sums, out);
}

void ComputePeriodSlopesUnknownMmf(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                                   const std::array<bool, kLanes>& excluded, PeriodSlopes* out) {
  Lane P0, P1, first, charge;
  Sums sum;
  Ends(m, in, out, &P0, &P1);
  Bridges(m, s, in, out);
  std::array<bool, kLanes> usable{};
  for (int j = 0; j < m.coils; ++j) {
    double least = 1e30;
    for (int k = 0; k < s.samples; ++k) least = std::min(least, in.adc[k][j]);
    usable[static_cast<std::size_t>(j)] = !excluded[static_cast<std::size_t>(j)] && least > 0.03;
  }
  for (int j = 0; j < kLanes; ++j) {
    sum.least_on[j] = sum.least_off[j] = 1e30;
    sum.largest[j] = -1e30;
  }
  for (int k = 0; k < s.samples; ++k) {
    Lane P, lambda;
    double top = 0, total = 0;
    for (int j = 0; j < m.coils; ++j) {
      P[j] = P0[j] + (P1[j] - P0[j]) * k / s.samples;
      top += P[j] * m.n[j] * in.adc[k][j];
      total += P[j];
    }
    double share = 0, weight = 0;
    for (int j = 0; j < m.coils; ++j) {
      const double i = in.adc[k][j], t = k * s.step, edge = out->edge[j];
      lambda[j] = m.n[j] * P[j] * (m.n[j] * i - top / total) + m.leakage[j] * i;
      if (k > 0) charge[j] += 0.5 * s.step * (i + in.adc[k - 1][j]);
      if (!usable[static_cast<std::size_t>(j)]) continue;
      const double driven = out->phase[0].voltage[j] * std::min(t, edge) + out->phase[1].voltage[j] * std::max(t - edge, 0.0);
      const double error = lambda[j] + m.resistance[j] * charge[j] - driven;
      if (k == 0) first[j] = error;
      share += m.n[j] * P[j] * (error - first[j]);
      weight += m.n[j] * m.n[j] * P[j] * P[j];
    }
    const double dU = weight > 0 ? share / weight : 0;  // error of -U since the first sample
    for (int j = 0; j < m.coils; ++j) {
      const double i = in.adc[k][j], y = lambda[j] - m.n[j] * P[j] * dU;
      const bool on = k < out->phase[0].samples[j];
      if (k == 0) sum.first[j] = y;
      if (k == s.samples - 1) sum.last[j] = y;
      sum.y[j] += y;
      sum.ky[j] += k * y;
      sum.i[j] += i;
      sum.ki[j] += k * i;
      sum.largest[j] = std::max(sum.largest[j], i);
      double& least = on ? sum.least_on[j] : sum.least_off[j];
      least = std::min(least, i);
      if (!on) continue;
      sum.y_on[j] += y;
      sum.ky_on[j] += k * y;
      sum.i_on[j] += i;
      sum.ki_on[j] += k * i;
    }
  }
  Finish(m, s, sum, out);
}

}  // namespace ambrig
