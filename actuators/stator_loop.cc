#include "actuators/stator_loop.h"

#include <tuple>
#include <utility>

#include "actuators/whole_lane_vector.h"

namespace ambrig {

namespace {

using V = LaneVector;

/// Volt-seconds of one sample from the two edges, by clamping.
template <class V>
struct VoltSeconds {
  V t1, t2, v2h, step1, step2, h;
  bool one_edge = true;  // nothing before t1: the usual pattern
  [[gnu::always_inline]] VoltSeconds(const StatorLoop& s, double sample) {
    const VoltagePattern& p = *s.pattern;
    const V v0 = LoadAs<V>(p.gain[0].v) * s.bus + LoadAs<V>(p.drop[0].v);
    const V v1 = LoadAs<V>(p.gain[1].v) * s.bus + LoadAs<V>(p.drop[1].v);
    const V v2 = LoadAs<V>(p.gain[2].v) * s.bus + LoadAs<V>(p.drop[2].v);
    t1 = LoadAs<V>(p.t1.v);
    t2 = LoadAs<V>(p.t2.v);
    for (int j = 0; j < kLanes; ++j) one_edge = one_edge && t1[j] <= 0;
    v2h = v2 * sample;
    step1 = v0 - v1;
    step2 = v1 - v2;
    h = sample;
  }
  [[gnu::always_inline]] static V Within(V a, const V& h) {
    return Min(Max(a, 0.0), h);
  }
  [[gnu::always_inline]] V Of(double t) const {
    const V after = v2h + step2 * Within(t2 - t, h);
    return one_edge ? after : after + step1 * Within(t1 - t, h);
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
  const VoltSeconds<V> volt_seconds(s, sample);
  V lambda = Load(s.lambda), i = Load(s.i), phi = Load(s.phi), sum = Load(s.sum);
  const double per = 1.0 / count;
  for (; k < count; ++k) {
    Store(s.samples[k].v, i);
    const V wanted = lambda + volt_seconds.Of(k * sample) - half_rh * i;
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

/// One bearing among several. Its chain from target to target is cut short by what does not
/// depend on the new currents:  λ - (R h/2) i = a λ* + (1 - a) n φ,  a = (L_l - R h/2)/(L_l + R h/2).
template <class V, Coupling kCoupling>
struct Running {
  V n, c, inverse_l, leakage, g0, dg, a, b, wanted, i, phi, sum, least;
  VoltSeconds<V> volt_seconds;
  double g0_sum, dg_sum;
  Lane* samples;

  [[gnu::always_inline]] Running(const StatorLoop& s, double sample) : volt_seconds(s, sample) {
    n = LoadAs<V>(s.n);
    c = LoadAs<V>(s.c);
    inverse_l = LoadAs<V>(s.inverse_l);
    leakage = LoadAs<V>(s.leakage);
    g0 = LoadAs<V>(s.g0);
    dg = LoadAs<V>(s.dg);
    const V half_rh = LoadAs<V>(s.half_rh);
    a = (leakage - half_rh) * inverse_l;
    b = (1 - a) * n;
    i = LoadAs<V>(s.i);
    phi = LoadAs<V>(s.phi);
    sum = V{};
    least = i;
    wanted = LoadAs<V>(s.lambda) - half_rh * i;
    g0_sum = Sum(g0);
    dg_sum = Sum(dg);
    samples = s.samples;
  }
  [[gnu::always_inline]] void Step(int k, double fraction, double t) {
    Store(samples[k].v, i);
    wanted += volt_seconds.Of(t);
    phi = Flux<kCoupling>(g0 + dg * fraction, c * wanted, 1 / (g0_sum + dg_sum * fraction));
    i = inverse_l * (wanted - n * phi);
    least = Min(i, least);
    sum += phi * phi;
    wanted = a * wanted + b * phi;
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

template <class V, Coupling... kAll, std::size_t... kAt>
[[gnu::always_inline]] inline unsigned Together(const StatorLoop* s, int count, double h, std::index_sequence<kAt...>) {
  std::tuple<Running<V, kAll>...> all(Running<V, kAll>(s[kAt], h)...);
  const double per = 1.0 / count;
  for (int k = 0; k < count; ++k) {
    const double fraction = (k + 1) * per, t = k * h;
    (std::get<kAt>(all).Step(k, fraction, t), ...);
  }
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

AMBRIG_WIDE void Reluctances(const GapLaw& law, double x0, double y0, double x1, double y1, double* rel0, double* rel1,
                             double* slope, double* g0, double* dg) {
  const V offset = Load(law.gap_offset), dx = Load(law.direction_x), dy = Load(law.direction_y);
  const V closest = 0.02 * law.reluctance.gap0;
  V start = offset - x0 * dx - y0 * dy, end = offset - x1 * dx - y1 * dy;
  start = Max(start, closest);
  end = Max(end, closest);
  const V first = law.reluctance.Value(start), last = law.reluctance.Value(end);
  const V n = Load(law.n), own = n * n * Load(law.inverse_l);
  const V nc = law.coupling == S ? own + Partner(own) : own;
  const V conductance = 1 / (first + nc);
  Store(rel0, first);
  Store(rel1, last);
  Store(slope, law.reluctance.Slope(V(0.5 * (start + end))));
  Store(g0, conductance);
  Store(dg, 1 / (last + nc) - conductance);
}

}  // namespace ambrig
