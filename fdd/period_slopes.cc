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

template <Coupling kCoupling>
[[gnu::always_inline]] inline LaneVector Linkage(const LaneVector& n, const LaneVector& leakage, const LaneVector& P,
                                                 const LaneVector& i) {
  const LaneVector mmf = n * i;
  if constexpr (kCoupling == Coupling::kFloatingRotor)
    return n * P * (mmf - Sum(P * mmf) / Sum(P)) + leakage * i;
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
  LaneVector least_on = far, least_off = far, largest = -far;
  for (int k = 0; k < count; ++k) {
    const LaneVector at = zero + static_cast<double>(k), i = Load(adc[k].v);
    const LaneVector lambda = Linkage<kCoupling>(n, leakage, p0 + dp * at, i);
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

/// Slope over n samples whose first index is `first`, from Σ y and Σ k y.
double Slope(double n, double first, double y, double ky, double step) {
  if (n < 2) return 0;
  return (ky - (first + 0.5 * (n - 1)) * y) * 12 / (n * (n * n - 1) * step);
}

void Bridges(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in, PeriodSlopes* out) {
  PhaseSlopes &on = out->phase[0], &off = out->phase[1];
  for (int j = 0; j < m.coils; ++j) {
    const BridgeVoltage v = VoltageOf(*s.amplifier, (*in.duty)[j], in.bus);
    // Sample k lies in the on phase when k h <= edge; the edge itself belongs to both.
    const double count = v.edge <= 0 ? 0 : std::min<double>(std::floor(v.edge / s.step * (1 + 1e-12)) + 1, s.samples);
    on.samples[j] = count;
    off.samples[j] = s.samples - count;
    out->edge[j] = v.edge;
    on.voltage[j] = v.on;
    off.voltage[j] = v.off;
  }
}

void Finish(const LinkageModel& m, const SamplingSettings& s, const Sums& sum, PeriodSlopes* out) {
  PhaseSlopes &on = out->phase[0], &off = out->phase[1];
  out->largest = sum.largest;
  out->first = sum.first;
  out->last = sum.last;
  on.least = sum.least_on;
  off.least = sum.least_off;
  for (int j = 0; j < m.coils; ++j) {
    const double a = on.samples[j], b = off.samples[j], i_off = sum.i[j] - sum.i_on[j];
    on.linkage[j] = Slope(a, 0, sum.y_on[j], sum.ky_on[j], s.step);
    off.linkage[j] = Slope(b, a, sum.y[j] - sum.y_on[j], sum.ky[j] - sum.ky_on[j], s.step);
    on.current[j] = Slope(a, 0, sum.i_on[j], sum.ki_on[j], s.step);
    off.current[j] = Slope(b, a, i_off, sum.ki[j] - sum.ki_on[j], s.step);
    on.mean[j] = a > 0 ? sum.i_on[j] / a : 0;
    off.mean[j] = b > 0 ? i_off / b : 0;
    on.residual[j] = on.linkage[j] + m.resistance[j] * on.mean[j] - on.voltage[j];
    off.residual[j] = off.linkage[j] + m.resistance[j] * off.mean[j] - off.voltage[j];
  }
}

/// Permeances at both ends, mean and sum for the middle.
void Ends(const LinkageModel& m, const MeasuredPeriod& in, PeriodSlopes* out, Lane* P0, Lane* P1) {
  *P0 = m.Permeance(in.x0, in.y0);
  *P1 = m.Permeance(in.x1, in.y1);
  out->total = 0;
  for (int j = 0; j < kLanes; ++j) {
    out->P[j] = 0.5 * (P0->v[j] + P1->v[j]);
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
