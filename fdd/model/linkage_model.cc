#include "fdd/model/linkage_model.h"

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {
/// A gap that noise or a wrong reading makes closed is taken as this share of the nominal one.

template <class V>
[[gnu::always_inline]] inline V ReluctanceAt(const LinkageModel& m, double x, double y) {
  const V offset = LoadAs<V>(m.gap_offset.v), least = offset * kLeastGap;
  return m.reluctance.Value(
      Max(offset - LoadAs<V>(m.direction_x.v) * x - LoadAs<V>(m.direction_y.v) * y, least));
}

AMBRIG_WIDE void AtOnePlace(const LinkageModel& m, double x, double y, Lane* P) {
  Store(P->v, Select(Load(m.gap_offset.v) > 0.0, 1 / ReluctanceAt<LaneVector>(m, x, y), 0.0));
}

template <class V>
[[gnu::always_inline]] inline void OverAMove(const LinkageModel& m, const double* from,
                                             const double* to, MovingPermeance* out) {
  const V none = 0.0, first = ReluctanceAt<V>(m, from[0], from[1]),
          last = ReluctanceAt<V>(m, to[0], to[1]);
  // one division for both
  const V inverse = Select(LoadAs<V>(m.gap_offset.v) > none, 1 / (first * last), none);
  const V start = last * inverse, end = first * inverse, middle = (start + end) * 0.5;
  Store(out->start.v, start);
  Store(out->end.v, end);
  Store(out->middle.v, middle);
  Store(out->change.v, end - start);
  out->total = Sum(middle);
  out->largest = Largest(middle);
}
AMBRIG_WHOLE void MoveWhole(const LinkageModel& m, const double* from, const double* to,
                            MovingPermeance* out) {
  OverAMove<WholeLaneVector>(m, from, to, out);
}
AMBRIG_WIDE void MoveHalves(const LinkageModel& m, const double* from, const double* to,
                            MovingPermeance* out) {
  OverAMove<LaneVector>(m, from, to, out);
}
}  // namespace

Lane LinkageModel::Permeance(double x, double y) const {
  Lane P;
  AtOnePlace(*this, x, y, &P);
  return P;
}

void LinkageModel::Permeance(const double* from, const double* to, MovingPermeance* out) const {
  (whole_lanes ? MoveWhole : MoveHalves)(*this, from, to, out);
}

double LinkageModel::SelfInductance(int j, const Lane& P, double total) const {
  const double own = coupling == Coupling::kFloatingRotor ? P[j] * (1 - P[j] / total) : P[j];
  return n[j] * n[j] * own + leakage[j];
}

double LinkageModel::SelfInductanceAt(int j, double x, double y) const {
  const Lane P = Permeance(x, y);
  double total = 0;
  for (const double p : P.v) total += p;
  return SelfInductance(j, P, total);
}

}  // namespace ambrig
