#include "fdd/linkage_model.h"

#include <algorithm>

namespace ambrig {

namespace {
/// A gap that noise or a wrong reading makes closed is taken as this share of the nominal one.
constexpr double kLeastGap = 0.05;
}  // namespace

Lane LinkageModel::Permeance(double x, double y) const {
  Lane P;
  for (int j = 0; j < coils; ++j) {
    const double gap = gap_offset[j] - x * direction_x[j] - y * direction_y[j];
    P[j] = 1 / reluctance.Value(std::max(gap, kLeastGap * gap_offset[j]));
  }
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
