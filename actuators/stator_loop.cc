#include "actuators/stator_loop.h"

#include <tuple>
#include <utility>

#include "actuators/whole_lane_vector.h"

namespace ambrig {

namespace {

using V = LaneVector;

/// Volt-seconds of one sample from the two edges: what an edge in it would give, clamped to what an edge
/// before or after it gives.
template <class V>
struct VoltSeconds {
  V first, first_falls, first_low, first_high;     // of the edge t1, relative to a period without it
  V second, second_falls, second_low, second_high; // of t2
  bool one_edge = true;  // nothing before t1: the usual pattern
  /// From sample k on, of `sample` seconds each.
  [[gnu::always_inline]] VoltSeconds(const StatorLoop& s, int k, double sample) {
    const VoltagePattern& p = *s.pattern;
    const V v0 = LoadAs<V>(p.gain[0].v) * s.bus + LoadAs<V>(p.drop[0].v);
    const V v1 = LoadAs<V>(p.gain[1].v) * s.bus + LoadAs<V>(p.drop[1].v);
    const V v2 = LoadAs<V>(p.gain[2].v) * s.bus + LoadAs<V>(p.drop[2].v);
    const V t1 = LoadAs<V>(p.t1.v), t2 = LoadAs<V>(p.t2.v), t = k * sample, none;
    for (int j = 0; j < kLanes; ++j) one_edge = one_edge && t1[j] <= 0;
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
    if (one_edge) return after;
    const V before = Min(Max(first, first_low), first_high);
    first = first - first_falls;
    return after + before;
  }
};

/// Flux that carries the targets λ*; `inverse_sum` is 1/Σg (radial only).
template <Coupling kCoupling, class V>
[[gnu::always_inline]] inline V Flux(const V& g, const V& m, double inverse_sum) {
  const V gm = g * m;
  if constexpr (kCoupling == Coupling::kFloatingRotor) {
    return gm - g * (Sum(gm) * inverse_sum);
  } else if constexpr (kCoupling == Coupling::kSides) {
    return g * (m + Partner(m));
  } else {
    return gm;
  }
}

template <Coupling kCoupling>
[[gnu::always_inline]] inline int Run(const StatorLoop& s, int k, int count, double sample, double* target) {
  const V n = Load(s.n), c = Load(s.c), inverse_l = Load(s.inverse_l), half_rh = Load(s.half_rh);
  const V leakage = Load(s.leakage), g0 = Load(s.g0), dg = Load(s.dg);
  VoltSeconds<V> volt_seconds(s, k, sample);
  V lambda = Load(s.lambda), i = Load(s.i), phi = Load(s.phi), sum = Load(s.sum);
  const double per = 1.0 / count;
  for (; k < count; ++k) {
    Store(s.samples[k].v, i);
    const V wanted = lambda + volt_seconds.Next() - half_rh * i;
    const V g = g0 + dg * ((k + 1) * per);
    phi = Flux<kCoupling>(g, c * wanted, kCoupling == Coupling::kFloatingRotor ? 1 / Sum(g) : 0);
    i = inverse_l * (wanted - n * phi);
    lambda = n * phi + leakage * i;
    if (-Largest(-i) < s.floor) {
      Store(target, wanted);
      break;
    }
    sum += phi * phi;
  }
  Store(s.lambda, lambda);
  Store(s.i, i);
  Store(s.phi, phi);
  Store(s.sum, sum);
  return k;
}

/// Of every sample of a period, and of the one after it: what a radial bearing's potential needs.
struct PotentialTables {
  static constexpr int kMost = 168;  // of StatorLanes::samples, and one, in whole vectors
  double inverse_sum[kMost];         // 1/Σ g'
  double passes_on[kMost];           // Σ g' c b g / Σ g'
};
constexpr Lane kFirstSamples = {{0, 1, 2, 3, 4, 5, 6, 7}};

/// One bearing among several: what does not depend on the new currents cuts the chain from target to
/// target short,  λ - (R h/2) i = a λ* + (1 - a) n φ,  a = (L_l - R h/2)/(L_l + R h/2).
template <class V>
struct RunningLanes {
  V n, c, inverse_l, leakage, a, b, wanted, i, phi, sum, least;
  V g, g_grows;  // conductance of this sample and its change from sample to sample
  VoltSeconds<V> volt_seconds;
  Lane* samples;

  [[gnu::always_inline]] RunningLanes(const StatorLoop& s, int count, double sample, PotentialTables&) : volt_seconds(s, 0, sample) {
    n = LoadAs<V>(s.n);
    c = LoadAs<V>(s.c);
    inverse_l = LoadAs<V>(s.inverse_l);
    leakage = LoadAs<V>(s.leakage);
    g_grows = LoadAs<V>(s.dg) * (1.0 / count);
    g = LoadAs<V>(s.g0) + g_grows;
    const V half_rh = LoadAs<V>(s.half_rh);
    a = (leakage - half_rh) * inverse_l;
    b = (1 - a) * n;
    i = LoadAs<V>(s.i);
    phi = LoadAs<V>(s.phi);
    sum = V{};
    least = i;
    wanted = LoadAs<V>(s.lambda) - half_rh * i;
    samples = s.samples;
  }
  [[gnu::always_inline]] void Currents(const V& target) {
    i = inverse_l * (target - n * phi);
    least = Min(i, least);
    sum += phi * phi;
  }
  [[gnu::always_inline]] unsigned Finish(const StatorLoop& s) const {
    if (-Largest(-least) < s.floor) return 1;
    Store(s.lambda, n * phi + leakage * i);
    Store(s.i, i);
    Store(s.phi, phi);
    Store(s.sum, sum);
    return 0;
  }
};

/// Poles that share no sum: windings of a thrust side, opposed magnets.
template <class V, Coupling kCoupling>
struct Running : RunningLanes<V> {
  using RunningLanes<V>::RunningLanes;
  [[gnu::always_inline]] void Step(int k) {
    Store(this->samples[k].v, this->i);
    const V target = this->wanted + this->volt_seconds.Next();
    this->phi = Flux<kCoupling>(this->g, this->c * target, 0);
    this->Currents(target);
    this->wanted = this->a * target + this->b * this->phi;
    this->g += this->g_grows;
  }
};

/// A radial bearing. The potential U = Σ g c λ* / Σ g of a sample waits for its targets, these for U of
/// the sample before. Summing over the poles what is known without U lets two samples' sums overlap:
///   λ*' = w - b g U,  w = (a + b g c) λ* + ∫v',   U' = (Σ g' c w - U Σ g' c b g) / Σ g'.
template <class V>
struct Running<V, Coupling::kFloatingRotor> : RunningLanes<V> {
  V target, gc, gc_grows, keeps, keeps_grows;      // g c and a + b g c, with their changes
  double U = 0;
  const PotentialTables& tables;

  [[gnu::always_inline]] Running(const StatorLoop& s, int count, double sample, PotentialTables& t)
      : RunningLanes<V>(s, count, sample, t), tables(t) {
    const V cb = this->c * this->b, g_first = this->g, grows = this->g_grows;
    gc = g_first * this->c;
    gc_grows = grows * this->c;
    keeps = this->a + this->b * gc;
    keeps_grows = this->b * gc_grows;
    const double total = Sum(g_first), total_grows = Sum(grows);
    const double q0 = Sum(cb * g_first * g_first), q1 = Sum(cb * g_first * grows), q2 = Sum(cb * grows * grows);
    V at = LoadAs<V>(kFirstSamples.v);
    for (int k = 0; k <= count; k += kLanes, at += kLanes) {
      const V inverse = 1 / (total + at * total_grows);
      Store(t.inverse_sum + k, inverse);
      Store(t.passes_on + k, (q0 + (2 * at - 1) * q1 + at * (at - 1) * q2) * inverse);
    }
    target = this->wanted + this->volt_seconds.Next();
    U = Sum(gc * target) * t.inverse_sum[0];
  }
  [[gnu::always_inline]] void Step(int k) {
    Store(this->samples[k].v, this->i);
    const V falls = this->g * U;
    this->phi = gc * target - falls;
    this->Currents(target);
    const V w = keeps * target + this->volt_seconds.Next();
    target = w - this->b * falls;
    this->g += this->g_grows;
    gc += gc_grows;
    keeps += keeps_grows;
    U = Sum(gc * w) * tables.inverse_sum[k + 1] - U * tables.passes_on[k + 1];
  }
};

template <class V, Coupling... kAll, std::size_t... kAt>
[[gnu::always_inline]] inline unsigned Together(const StatorLoop* s, int count, double h, std::index_sequence<kAt...>) {
  PotentialTables tables[sizeof...(kAt)];
  std::tuple<Running<V, kAll>...> all(Running<V, kAll>(s[kAt], count, h, tables[kAt])...);
  for (int k = 0; k < count; ++k) (std::get<kAt>(all).Step(k), ...);
  return ((std::get<kAt>(all).Finish(s[kAt]) << kAt) | ...);
}
template <class V, Coupling... kAll>
[[gnu::always_inline]] inline unsigned Together(const StatorLoop* s, int count, double h) {
  return Together<V, kAll...>(s, count, h, std::make_index_sequence<sizeof...(kAll)>());
}

constexpr Coupling R = Coupling::kFloatingRotor, S = Coupling::kSides, N = Coupling::kNone;

AMBRIG_WHOLE unsigned RRSWhole(const StatorLoop* s, int n, double h) { return Together<WholeLaneVector, R, R, S>(s, n, h); }
AMBRIG_WHOLE unsigned RRWhole(const StatorLoop* s, int n, double h) { return Together<WholeLaneVector, R, R>(s, n, h); }
AMBRIG_WHOLE unsigned RWhole(const StatorLoop* s, int n, double h) { return Together<WholeLaneVector, R>(s, n, h); }
AMBRIG_WIDE unsigned RRSHalves(const StatorLoop* s, int n, double h) { return Together<V, R, R, S>(s, n, h); }
AMBRIG_WIDE unsigned RRHalves(const StatorLoop* s, int n, double h) { return Together<V, R, R>(s, n, h); }
AMBRIG_WIDE unsigned RHalves(const StatorLoop* s, int n, double h) { return Together<V, R>(s, n, h); }
AMBRIG_WIDE unsigned TogetherS(const StatorLoop* s, int n, double h) { return Together<V, S>(s, n, h); }
AMBRIG_WIDE unsigned TogetherN(const StatorLoop* s, int n, double h) { return Together<V, N>(s, n, h); }

AMBRIG_WIDE int RunRadial(const StatorLoop& s, int k, int n, double h, double* target) { return Run<R>(s, k, n, h, target); }
AMBRIG_WIDE int RunSides(const StatorLoop& s, int k, int n, double h, double* target) { return Run<S>(s, k, n, h, target); }
AMBRIG_WIDE int RunSeparate(const StatorLoop& s, int k, int n, double h, double* target) { return Run<N>(s, k, n, h, target); }

template <Coupling kCoupling>
void Solve(const StatorLoop& s, const double* target, double fraction) {
  const V g = Load(s.g0) + Load(s.dg) * fraction, wanted = Load(target);
  const V phi = Flux<kCoupling>(g, Load(s.c) * wanted, 1 / Sum(g));
  const V i = Load(s.inverse_l) * (wanted - Load(s.n) * phi);
  Store(s.phi, phi);
  Store(s.i, i);
  Store(s.lambda, Load(s.n) * phi + Load(s.leakage) * i);
}

}  // namespace

int RunSamples(const StatorLoop& s, int k, int count, double h, double* target) {
  const auto run = s.coupling == R ? RunRadial : s.coupling == S ? RunSides : RunSeparate;
  return run(s, k, count, h, target);
}

unsigned RunTogether(const StatorLoop* s, int bearings, int count, double h) {
  const auto is = [&](int at, Coupling c) { return at < bearings && s[at].coupling == c; };
  unsigned below = 0;
  for (int at = 0; at < bearings;) {
    if (is(at, R) && is(at + 1, R) && is(at + 2, S)) {
      below |= (whole_lanes ? RRSWhole : RRSHalves)(s + at, count, h) << at;
      at += 3;
    } else if (is(at, R) && is(at + 1, R)) {
      below |= (whole_lanes ? RRWhole : RRHalves)(s + at, count, h) << at;
      at += 2;
    } else {
      const auto run = s[at].coupling == R ? (whole_lanes ? RWhole : RHalves) : s[at].coupling == S ? TogetherS : TogetherN;
      below |= run(s + at, count, h) << at;
      at += 1;
    }
  }
  return below;
}

void SolveSample(const StatorLoop& s, const double* target, double fraction) {
  switch (s.coupling) {
    case R: return Solve<R>(s, target, fraction);
    case S: return Solve<S>(s, target, fraction);
    case N: return Solve<N>(s, target, fraction);
  }
}

namespace {

template <class V>
[[gnu::always_inline]] inline void ReluctancesOf(const GapLaw& law, const double* from, const double* to, double* rel0, double* rel1,
                                                 double* slope, double* g0, double* dg) {
  const V offset = LoadAs<V>(law.gap_offset), dx = LoadAs<V>(law.direction_x), dy = LoadAs<V>(law.direction_y);
  const V closest = 0.02 * law.reluctance.gap0;
  const V start = Max(offset - dx * from[0] - dy * from[1], closest), end = Max(offset - dx * to[0] - dy * to[1], closest);
  const V first = law.reluctance.Value(start), last = law.reluctance.Value(end);
  const V n = LoadAs<V>(law.n), own = n * n * LoadAs<V>(law.inverse_l);
  const V nc = law.coupling == S ? own + Partner(own) : own;
  const V inverse = 1 / ((first + nc) * (last + nc));  // one division for both
  Store(rel0, first);
  Store(rel1, last);
  Store(slope, law.reluctance.Slope(V(0.5 * (start + end))));
  Store(g0, (last + nc) * inverse);
  Store(dg, (first - last) * inverse);
}

template <class V>
[[gnu::always_inline]] inline void MeanPullOf(const PullOfPeriod& p, int count, double* fx, double* fy) {
  const V phi = LoadAs<V>(p.phi), squares = LoadAs<V>(p.sum) + 0.5 * (LoadAs<V>(p.start_sq) - phi * phi);
  const V pull = LoadAs<V>(p.weight) * squares * (1.0 / count);
  *fx = Sum(pull * LoadAs<V>(p.direction_x));
  *fy = Sum(pull * LoadAs<V>(p.direction_y));
}

AMBRIG_WHOLE void ReluctancesWhole(const GapLaw& law, const double* from, const double* to, double* rel0, double* rel1, double* slope,
                                   double* g0, double* dg) {
  ReluctancesOf<WholeLaneVector>(law, from, to, rel0, rel1, slope, g0, dg);
}
AMBRIG_WIDE void ReluctancesHalves(const GapLaw& law, const double* from, const double* to, double* rel0, double* rel1, double* slope,
                                   double* g0, double* dg) {
  ReluctancesOf<V>(law, from, to, rel0, rel1, slope, g0, dg);
}
AMBRIG_WHOLE void MeanPullWhole(const PullOfPeriod& p, int count, double* fx, double* fy) { MeanPullOf<WholeLaneVector>(p, count, fx, fy); }
AMBRIG_WIDE void MeanPullHalves(const PullOfPeriod& p, int count, double* fx, double* fy) { MeanPullOf<V>(p, count, fx, fy); }

}  // namespace

void Reluctances(const GapLaw& law, double x0, double y0, double x1, double y1, double* rel0, double* rel1, double* slope,
                 double* g0, double* dg) {
  const double from[2] = {x0, y0}, to[2] = {x1, y1};
  (whole_lanes ? ReluctancesWhole : ReluctancesHalves)(law, from, to, rel0, rel1, slope, g0, dg);
}

void MeanPull(const PullOfPeriod& p, int count, double* fx, double* fy) {
  (whole_lanes ? MeanPullWhole : MeanPullHalves)(p, count, fx, fy);
}

}  // namespace ambrig
