#include "actuators/magnetics/stator_geometry.h"

#include <cmath>

namespace ambrig {

StatorGeometry GeometryOf(const RadialStatorParameters& p) {
  const RadialStator stator(p);
  StatorGeometry g;
  g.coupling = Coupling::kFloatingRotor;
  g.coils = kPoles;
  g.reluctance.per_metre = 1 / (kMu0 * p.pole_area);
  g.reluctance.gap0 = p.gap;
  for (int j = 0; j < kPoles; ++j) {
    g.n[j] = stator.sense()[j] * p.turns;
    g.leakage[j] = p.leakage_inductance;
    g.resistance[j] = p.resistance;
    g.direction_x[j] = stator.cosine()[j];
    g.direction_y[j] = stator.sine()[j];
    g.gap_offset[j] = p.gap;
  }
  return g;
}

StatorGeometry GeometryOf(const ThrustStatorParameters& p) {
  StatorGeometry g;
  g.coupling = Coupling::kSides;
  g.coils = kThrustCoils;
  g.reluctance.per_metre = 2 / (kMu0 * p.pole_area);
  g.reluctance.gap0 = p.gap;
  for (int j = 0; j < kThrustCoils; ++j) {
    g.n[j] = p.turns;
    g.leakage[j] = p.leakage_inductance;
    g.resistance[j] = p.resistance;
    g.direction_x[j] = j < 2 ? 1 : -1;  // along z
    g.gap_offset[j] = p.gap;
  }
  return g;
}

StatorGeometry GeometryOf(const OpposedStatorParameters& p) {
  StatorGeometry g;
  g.coupling = Coupling::kNone;
  g.coils = static_cast<int>(p.coils);
  // One "turn": N² P(g) = L_0/(1 + g/g_c).
  g.reluctance.per_metre = 1 / (p.gap_constant * p.inductance_near);
  g.reluctance.offset = 1 / p.inductance_near;
  g.reluctance.gap0 = p.gap;
  for (int j = 0; j < g.coils; ++j) {
    g.n[j] = 1;
    g.leakage[j] = p.inductance_far;
    g.resistance[j] = p.resistance;
    g.direction_x[j] = j == 0 ? 1 : -1;
    g.gap_offset[j] = p.gap;
  }
  return g;
}

namespace {

/// The pole that coil `j` alone is wound on, and that has no other coil; -1: there is none.
int PoleOf(const PoleNetwork& network, int j) {
  int found = -1;
  for (int p = 0; p < network.poles(); ++p) {
    if (network.turns()(p, j) == 0) continue;
    if (found >= 0 || (network.turns().row(p).array() != 0).count() != 1) return -1;
    found = p;
  }
  return found;
}

/// Whether two poles are alike but for their direction in the plane.
bool AreAlike(const NetworkPole& a, const NetworkPole& b) {
  return a.area == b.area && a.gap == b.gap && a.part == b.part && a.direction[2] == 0 &&
         b.direction[2] == 0 && a.reluctance == 0 && b.reluctance == 0;
}

}  // namespace

std::optional<StatorGeometry> PoleByPole(const StatorGeometry& stator) {
  if (stator.coupling != Coupling::kNetwork) return std::nullopt;
  const PoleNetwork& network = *stator.network;
  if (network.has_magnets() || network.poles() != network.coils()) return std::nullopt;
  StatorGeometry g = stator;
  g.coupling = Coupling::kFloatingRotor;
  g.network = nullptr;
  for (int j = 0; j < g.coils; ++j) {
    const int p = PoleOf(network, j);
    if (p < 0 || !AreAlike(network.pole(p), network.pole(0))) return std::nullopt;
    g.n[j] = network.turns()(p, j);
    g.direction_x[j] = network.pole(p).direction[0];
    g.direction_y[j] = network.pole(p).direction[1];
    g.gap_offset[j] = network.pole(p).gap;
  }
  return g;
}

std::vector<std::array<double, 2>> StatorGeometry::Directions() const {
  std::vector<std::array<double, 2>> out;
  for (int j = 0; j < coils; ++j) out.push_back({direction_x[j], direction_y[j]});
  return out;
}

std::vector<double> StatorGeometry::Angles() const {
  std::vector<double> out;
  for (int j = 0; j < coils; ++j) out.push_back(std::atan2(direction_y[j], direction_x[j]));
  return out;
}

}  // namespace ambrig
