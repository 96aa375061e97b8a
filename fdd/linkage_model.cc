#include "fdd/linkage_model.h"

#include "actuators/lane_vector.h"

namespace ambrig {

namespace {
/// A gap that noise or a wrong reading makes closed is taken as this share of the nominal one.
constexpr double kLeastGap = 0.05;

AMBRIG_WIDE void Permeances(const LinkageModel& m, double x, double y, Lane* out) {
  const LaneVector zero = {}, offset = Load(m.gap_offset.v), least = kLeastGap * offset;
  const GapReluctance& r = m.reluctance;
  LaneVector gap = offset - x * Load(m.direction_x.v) - y * Load(m.direction_y.v);
  gap = gap < least ? least : gap;
  if (r.fringing != 0) gap = gap / (1 + r.fringing * gap / r.gap0);
  const LaneVector reluctance = r.per_metre * (gap + r.iron_path) + r.offset;
  Store(out->v, offset > zero ? 1 / reluctance : zero);
}
}  // namespace

Lane LinkageModel::Permeance(double x, double y) const {
  Lane P;
  Permeances(*this, x, y, &P);
  return P;
}

double LinkageModel::SelfInductance(int j, const Lane& P, double total) const {
  const double own = coupling == Coupling::kFloatingRotor ? P[j] * (1 - P[j] / total) : P[j];
  return n[j] * n[j] * own + leakage[j];
}

LinkageModel MakeLinkageModel(const RadialStatorParameters& p) {
  const RadialStator stator(p);
  LinkageModel m;
  m.coupling = Coupling::kFloatingRotor;
  m.coils = kPoles;
  m.reluctance.per_metre = 1 / (kMu0 * p.pole_area);
  m.reluctance.gap0 = p.gap;
  for (int j = 0; j < kPoles; ++j) {
    m.n[j] = stator.sense()[j] * p.turns;
    m.leakage[j] = p.leakage_inductance;
    m.resistance[j] = p.resistance;
    m.direction_x[j] = stator.cosine()[j];
    m.direction_y[j] = stator.sine()[j];
    m.gap_offset[j] = p.gap;
  }
  return m;
}

LinkageModel MakeLinkageModel(const ThrustStatorParameters& p) {
  LinkageModel m;
  m.coupling = Coupling::kSides;
  m.coils = kThrustCoils;
  m.reluctance.per_metre = 2 / (kMu0 * p.pole_area);
  m.reluctance.gap0 = p.gap;
  for (int j = 0; j < kThrustCoils; ++j) {
    m.n[j] = p.turns;
    m.leakage[j] = p.leakage_inductance;
    m.resistance[j] = p.resistance;
    m.direction_x[j] = j < 2 ? 1 : -1;
    m.gap_offset[j] = p.gap;
  }
  return m;
}

}  // namespace ambrig
