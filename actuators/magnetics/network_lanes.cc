#include "actuators/magnetics/network_lanes.h"

#include "actuators/magnetics/lane_vector.h"
#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {
using V = LaneVector;
}  // namespace

NetworkPlace PlaceOf(const PoleNetwork& network, double x, double y) {
  NetworkPlace out;
  out.network = &network;
  out.x = x, out.y = y;
  out.coils = network.coils();
  Require(out.coils <= kLanes, "a coil per lane");
  out.groups = (network.poles() + kLanes - 1) / kLanes;
  const PoleMatrix phi = network.FluxAt({x, y, 0}).phi;
  const WindingMatrix linkage = network.Linkage(phi);
  const auto take = [&](int from, double per, NetworkColumn* to) {
    for (int j = 0; j < out.coils; ++j) to->turn[j] = linkage(j, from) / network.TurnsOf(j) * per;
    for (int p = 0; p < network.poles(); ++p) to->pole[p / kLanes][p % kLanes] = phi(p, from) * per;
  };
  for (int c = 0; c < out.coils; ++c) take(c, 1 / network.TurnsOf(c), &out.column[c]);
  take(out.coils, 1, &out.magnets);
  for (int p = 0; p < network.poles(); ++p) {
    const NetworkPole& pole = network.pole(p);
    const double pull = 1 / (2 * kMu0 * pole.area);
    out.pull_x[p / kLanes][p % kLanes] = pull * pole.direction[0];
    out.pull_y[p / kLanes][p % kLanes] = pull * pole.direction[1];
  }
  return out;
}

AMBRIG_WIDE void PlaceBetween(const NetworkPlace& a, const NetworkPlace& b, double fraction,
                              NetworkPlace* out) {
  const auto lane = [&](const Lane& from, const Lane& to, Lane* at) {
    const V start = Load(from.v);
    Store(at->v, start + (Load(to.v) - start) * fraction);
  };
  const auto column = [&](const NetworkColumn& from, const NetworkColumn& to, NetworkColumn* at) {
    lane(from.turn, to.turn, &at->turn);
    for (int g = 0; g < a.groups; ++g) lane(from.pole[g], to.pole[g], &at->pole[g]);
  };
  for (int c = 0; c < a.coils; ++c) column(a.column[c], b.column[c], &out->column[c]);
  column(a.magnets, b.magnets, &out->magnets);
}

namespace {

AMBRIG_INLINE V Flux(const NetworkPlace& place, const Lane& ampere_turns) {
  V flux = Load(place.magnets.turn.v);
  for (int c = 0; c < place.coils; ++c) flux += Load(place.column[c].turn.v) * ampere_turns[c];
  return flux;
}

/// Elimination of up to N coils, all in registers: three times as fast as a loop over the coils.
template <int N>
AMBRIG_INLINE Lane Eliminated(const NetworkPlace& place, const Lane& source, const Lane& own) {
  const V K = Load(own.v), start = Flux(place, source);
  V row[N];
  double right[N], inverse[N];
#pragma GCC unroll 8
  for (int j = 0; j < N; ++j) {
    V one;
    if (j < 4)
      one.a[j] = 1;
    else
      one.b[j - 4] = 1;
    row[j] = Load(place.column[j].turn.v) * K + one;  // P is symmetric
    right[j] = start[j];
  }
#pragma GCC unroll 8
  for (int k = 0; k < N; ++k) {
    inverse[k] = 1 / row[k][k];
#pragma GCC unroll 8
    for (int j = k + 1; j < N; ++j) {
      const double share = row[j][k] * inverse[k];
      row[j] = row[j] - row[k] * share;
      right[j] -= right[k] * share;
    }
  }
  Lane flux;
#pragma GCC unroll 8
  for (int k = N - 1; k >= 0; --k) {
    double sum = right[k];
#pragma GCC unroll 8
    for (int j = k + 1; j < N; ++j) sum -= row[k][j] * flux[j];
    flux[k] = sum * inverse[k];
  }
  return flux;
}

}  // namespace

AMBRIG_WIDE Lane FluxUnder(const NetworkPlace& place, const Lane& ampere_turns) {
  Lane out;
  Store(out.v, Flux(place, ampere_turns));
  return out;
}

AMBRIG_WIDE Lane FluxOfSources(const NetworkPlace& place, const Lane& source, const Lane& own) {
  if (place.coils <= 4) return Eliminated<4>(place, source, own);
  if (place.coils <= 6) return Eliminated<6>(place, source, own);
  return Eliminated<kLanes>(place, source, own);
}

AMBRIG_WIDE Eigen::Vector2d PullUnder(const NetworkPlace& place, const Lane& ampere_turns) {
  V fx = 0.0, fy = 0.0;
  for (int g = 0; g < place.groups; ++g) {
    V flux = Load(place.magnets.pole[g].v);
    for (int c = 0; c < place.coils; ++c) flux += Load(place.column[c].pole[g].v) * ampere_turns[c];
    const V square = flux * flux;
    fx += Load(place.pull_x[g].v) * square;
    fy += Load(place.pull_y[g].v) * square;
  }
  return {Sum(fx), Sum(fy)};
}

}  // namespace ambrig
