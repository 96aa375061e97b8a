#pragma once
/// One bearing in the innermost loop of the fast engine, as a template of its vector; see
/// stator_loop.cc.
///
/// Carried from sample to sample is J = λ*/(L_l + R h/2), the current that the targets λ* would
/// drive without flux, so that what does not depend on the new currents cuts the chain short:
///   φ = g (n J - U),   i = J - c φ,   J' = a J + d φ + ∫v'/(L_l + R h/2),
///   a = (L_l - R h/2)/(L_l + R h/2),  d = (1 - a) c
#include "actuators/magnetics/first_lanes.h"
#include "actuators/magnetics/stator_loop.h"
#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

/// Volt-seconds of one sample from the two edges, over L_l + R h/2 [A]: what an edge in the sample
/// would give, clamped to what an edge before or after it gives.
template <class V>
struct VoltSeconds {
  // of the edge t1, relative to a period without it
  V first, first_falls, first_low, first_high;
  V second, second_falls, second_low, second_high;  // of t2
  bool one_edge;                                    // nothing before t1: the usual pattern
  /// From sample k on, of `sample` seconds each; `scale` [1/H].
  [[gnu::always_inline]] VoltSeconds(const StatorLoop& s, int k, double sample, const V& scale) {
    const VoltagePattern& p = *s.pattern;
    const V v0 = (LoadAs<V>(p.gain[0].v) * s.bus + LoadAs<V>(p.drop[0].v)) * scale;
    const V v1 = (LoadAs<V>(p.gain[1].v) * s.bus + LoadAs<V>(p.drop[1].v)) * scale;
    const V v2 = (LoadAs<V>(p.gain[2].v) * s.bus + LoadAs<V>(p.drop[2].v)) * scale;
    const V t1 = LoadAs<V>(p.t1.v), t2 = LoadAs<V>(p.t2.v), t = k * sample, none;
    one_edge = Largest(t1) <= 0;
    const V step1 = v0 - v1, step2 = v1 - v2;
    first_falls = step1 * sample;
    first = step1 * (t1 - t);
    first_low = Min(first_falls, none);
    first_high = Max(first_falls, none);
    second_falls = step2 * sample;
    second = v2 * sample + step2 * (t2 - t);
    second_low = Min(v1 * sample, v2 * sample);
    second_high = Max(v1 * sample, v2 * sample);
  }
  [[gnu::always_inline]] V Next() {
    const V after = Min(Max(second, second_low), second_high);
    second = second - second_falls;
    if (one_edge) [[likely]]
      return after;
    const V before = Min(Max(first, first_low), first_high);
    first = first - first_falls;
    return after + before;
  }
};

/// Of every sample of a period, and of the one after it: what a radial bearing's potential needs.
struct PotentialTables {
  static constexpr int kMost = 168;  // of StatorLanes::samples, and one, in whole vectors
  double inverse_sum[kMost];         // 1/Σ g'
  double passes_on[kMost];           // Σ g' n d g / Σ g'
};
constexpr Lane kFirstSamples = {{0, 1, 2, 3, 4, 5, 6, 7}};

template <class V>
struct RunningLanes {
  V n, c, a, d, J, i, phi, sum, least;
  V g, g_grows;  // conductance of this sample and its change from sample to sample
  VoltSeconds<V> volt_seconds;
  Lane* samples;

  [[gnu::always_inline]] RunningLanes(const StatorLoop& s, int count, double sample)
      : volt_seconds(s, 0, sample, LoadAs<V>(s.inverse_l)) {
    const V inverse_l = LoadAs<V>(s.inverse_l), half_rh = LoadAs<V>(s.half_rh);
    n = LoadAs<V>(s.n);
    c = LoadAs<V>(s.c);
    g_grows = LoadAs<V>(s.dg) * (1.0 / count);
    g = LoadAs<V>(s.g0) + g_grows;
    a = (LoadAs<V>(s.leakage) - half_rh) * inverse_l;
    d = (1 - a) * c;
    i = LoadAs<V>(s.i);
    phi = LoadAs<V>(s.phi);
    sum = V{};
    least = i;
    J = (LoadAs<V>(s.lambda) - half_rh * i) * inverse_l + volt_seconds.Next();
    samples = s.samples;
  }
  [[gnu::always_inline]] void Currents() {
    i = J - c * phi;
    least = Min(i, least);
    sum += phi * phi;
  }
  [[gnu::always_inline]] unsigned Finish(const StatorLoop& s) const {
    if (-Largest(-least) < s.floor) return 1;
    Store(s.lambda, n * phi + LoadAs<V>(s.leakage) * i);
    Store(s.i, i);
    Store(s.phi, phi);
    Store(s.sum, sum);
    return 0;
  }
};

/// Poles that share no sum: windings of a thrust side, opposed magnets.
template <class V, Coupling kCoupling>
struct Running : RunningLanes<V> {
  [[gnu::always_inline]] Running(const StatorLoop& s, int count, double sample, PotentialTables&)
      : RunningLanes<V>(s, count, sample) {}
  [[gnu::always_inline]] void Step(int k) {
    Store(this->samples[k].v, this->i);
    const V m = this->n * this->J;
    const V mmf = kCoupling == Coupling::kSides ? m + Partner(m) : m;
    this->phi = this->g * mmf;
    this->Currents();
    this->J = this->a * this->J + this->volt_seconds.Next() + this->g * this->d * mmf;
    this->g += this->g_grows;
  }
};

/// A radial bearing. The potential U = Σ g n J / Σ g of a sample waits for its J, these for U of
/// the sample before. Summing over the poles what is known without U lets two samples' sums
/// overlap:
///   J' = W - d g U,  W = (a + d g n) J + ∫v'/(L_l + R h/2),
///     U' = (Σ g' n W - U Σ g' n d g) / Σ g'.
template <class V>
struct Running<V, Coupling::kFloatingRotor> : RunningLanes<V> {
  V gn;
  CommonOf<V> U;
  const PotentialTables& tables;

  [[gnu::always_inline]] Running(const StatorLoop& s, int count, double sample, PotentialTables& t)
      : RunningLanes<V>(s, count, sample), tables(t) {
    const V nd = this->n * this->d, first = this->g, grows = this->g_grows;
    const double total = Sum(first), total_grows = Sum(grows);
    const double q0 = Sum(nd * first * first), q1 = Sum(nd * first * grows),
                 q2 = Sum(nd * grows * grows);
    V at = LoadAs<V>(kFirstSamples.v);
    for (int k = 0; k <= count; k += kLanes, at += kLanes) {
      const V inverse = 1 / (total + at * total_grows);
      Store(t.inverse_sum + k, inverse);
      Store(t.passes_on + k, (q0 + (2 * at - 1) * q1 + at * (at - 1) * q2) * inverse);
    }
    gn = this->g * this->n;
    U = CommonSum(gn * t.inverse_sum[0] * this->J);
  }
  [[gnu::always_inline]] void Step(int k) {
    Store(this->samples[k].v, this->i);
    const V W = (this->a + this->d * gn) * this->J + this->volt_seconds.Next();
    this->phi = gn * this->J - this->g * U;
    this->Currents();
    this->J = W - this->d * this->g * U;
    this->g += this->g_grows;
    gn = this->g * this->n;
    U = CommonSum(gn * tables.inverse_sum[k + 1] * W) - U * tables.passes_on[k + 1];
  }
};

}  // namespace ambrig
