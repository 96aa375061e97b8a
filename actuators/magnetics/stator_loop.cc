#include "actuators/magnetics/stator_loop.h"

#include <tuple>
#include <utility>

#include "actuators/magnetics/running_stator.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

using V = LaneVector;

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
[[gnu::always_inline]] inline int Run(const StatorLoop& s, int k, int count, double sample,
                                      double* target) {
  const V n = Load(s.n), c = Load(s.c), inverse_l = Load(s.inverse_l), half_rh = Load(s.half_rh);
  const V leakage = Load(s.leakage), g0 = Load(s.g0), dg = Load(s.dg);
  VoltSeconds<V> volt_seconds(s, k, sample, V(1));
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

template <class... kBearings, std::size_t... kAt>
[[gnu::always_inline]] inline unsigned Together(const StatorLoop* s, int count, double h,
                                                std::index_sequence<kAt...>) {
  PotentialTables tables[sizeof...(kAt)];
  std::tuple<kBearings...> all(kBearings(s[kAt], count, h, tables[kAt])...);
  for (int k = 0; k < count; ++k) (std::get<kAt>(all).Step(k), ...);
  return ((std::get<kAt>(all).Finish(s[kAt]) << kAt) | ...);
}
template <class... kBearings>
[[gnu::always_inline]] inline unsigned Together(const StatorLoop* s, int count, double h) {
  return Together<kBearings...>(s, count, h, std::make_index_sequence<sizeof...(kBearings)>());
}

constexpr Coupling R = Coupling::kFloatingRotor, S = Coupling::kSides, N = Coupling::kNone;

template <class V>
using Radial = Running<V, R>;
using ThrustOfFour = Running<FirstLanes, S>;

AMBRIG_WHOLE unsigned RRSWhole(const StatorLoop* s, int n, double h) {
  return Together<Radial<WholeLaneVector>, Radial<WholeLaneVector>, Running<WholeLaneVector, S>>(
      s, n, h);
}
AMBRIG_WHOLE unsigned RRWhole(const StatorLoop* s, int n, double h) {
  return Together<Radial<WholeLaneVector>, Radial<WholeLaneVector>>(s, n, h);
}
AMBRIG_WHOLE unsigned RWhole(const StatorLoop* s, int n, double h) {
  return Together<Radial<WholeLaneVector>>(s, n, h);
}
AMBRIG_WIDE unsigned RRSHalves(const StatorLoop* s, int n, double h) {
  return Together<Radial<V>, Radial<V>, ThrustOfFour>(s, n, h);
}
AMBRIG_WIDE unsigned RRHalves(const StatorLoop* s, int n, double h) {
  return Together<Radial<V>, Radial<V>>(s, n, h);
}
AMBRIG_WIDE unsigned RHalves(const StatorLoop* s, int n, double h) {
  return Together<Radial<V>>(s, n, h);
}
AMBRIG_WIDE unsigned TogetherS(const StatorLoop* s, int n, double h) {
  return Together<ThrustOfFour>(s, n, h);
}
AMBRIG_WIDE unsigned TogetherN(const StatorLoop* s, int n, double h) {
  return Together<Running<V, N>>(s, n, h);
}

AMBRIG_WIDE int RunRadial(const StatorLoop& s, int k, int n, double h, double* target) {
  return Run<R>(s, k, n, h, target);
}
AMBRIG_WIDE int RunSides(const StatorLoop& s, int k, int n, double h, double* target) {
  return Run<S>(s, k, n, h, target);
}
AMBRIG_WIDE int RunSeparate(const StatorLoop& s, int k, int n, double h, double* target) {
  return Run<N>(s, k, n, h, target);
}

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
      const auto run = s[at].coupling == R   ? (whole_lanes ? RWhole : RHalves)
                       : s[at].coupling == S ? TogetherS
                                             : TogetherN;
      below |= run(s + at, count, h) << at;
      at += 1;
    }
  }
  return below;
}

void SolveSample(const StatorLoop& s, const double* target, double fraction) {
  switch (s.coupling) {
    case R:
      return Solve<R>(s, target, fraction);
    case S:
      return Solve<S>(s, target, fraction);
    case N:
      return Solve<N>(s, target, fraction);
    case Coupling::kNetwork:
      Require(false, "a stator of the fast path");
  }
}

namespace {

template <class V>
[[gnu::always_inline]] inline void ReluctancesOf(const GapLaw& law, const double* from,
                                                 const double* to, double* rel0, double* rel1,
                                                 double* slope, double* g0, double* dg) {
  const V offset = LoadAs<V>(law.gap_offset), dx = LoadAs<V>(law.direction_x),
          dy = LoadAs<V>(law.direction_y);
  const V closest = kGapAtPole * law.reluctance.gap0;
  const V start = Max(offset - dx * from[0] - dy * from[1], closest),
          end = Max(offset - dx * to[0] - dy * to[1], closest);
  const V first = law.reluctance.Value(start), last = law.reluctance.Value(end);
  const V n = LoadAs<V>(law.n), own = n * n * LoadAs<V>(law.inverse_l);
  const V nc = law.coupling == S ? own + Partner(own) : own;
  const V inverse = 1 / ((first + nc) * (last + nc));  // one division for both
  Store(rel0, first);
  Store(rel1, last);
  Store(slope, law.reluctance.Pull(V(0.5 * (start + end))));
  Store(g0, (last + nc) * inverse);
  Store(dg, (first - last) * inverse);
}

template <class V>
[[gnu::always_inline]] inline void MeanPullOf(const PullOfPeriod& p, int count, double* fx,
                                              double* fy) {
  const V phi = LoadAs<V>(p.phi),
          squares = LoadAs<V>(p.sum) + 0.5 * (LoadAs<V>(p.start_sq) - phi * phi);
  const V pull = LoadAs<V>(p.weight) * squares * (1.0 / count);
  *fx = Sum(pull * LoadAs<V>(p.direction_x));
  *fy = Sum(pull * LoadAs<V>(p.direction_y));
}

AMBRIG_WHOLE void ReluctancesWhole(const GapLaw& law, const double* from, const double* to,
                                   double* rel0, double* rel1, double* slope, double* g0,
                                   double* dg) {
  ReluctancesOf<WholeLaneVector>(law, from, to, rel0, rel1, slope, g0, dg);
}
AMBRIG_WIDE void ReluctancesHalves(const GapLaw& law, const double* from, const double* to,
                                   double* rel0, double* rel1, double* slope, double* g0,
                                   double* dg) {
  ReluctancesOf<V>(law, from, to, rel0, rel1, slope, g0, dg);
}
AMBRIG_WHOLE void MeanPullWhole(const PullOfPeriod& p, int count, double* fx, double* fy) {
  MeanPullOf<WholeLaneVector>(p, count, fx, fy);
}
AMBRIG_WIDE void MeanPullHalves(const PullOfPeriod& p, int count, double* fx, double* fy) {
  MeanPullOf<V>(p, count, fx, fy);
}

}  // namespace

void Reluctances(const GapLaw& law, double x0, double y0, double x1, double y1, double* rel0,
                 double* rel1, double* slope, double* g0, double* dg) {
  const double from[2] = {x0, y0}, to[2] = {x1, y1};
  (whole_lanes ? ReluctancesWhole : ReluctancesHalves)(law, from, to, rel0, rel1, slope, g0, dg);
}

void MeanPull(const PullOfPeriod& p, int count, double* fx, double* fy) {
  (whole_lanes ? MeanPullWhole : MeanPullHalves)(p, count, fx, fy);
}

}  // namespace ambrig
