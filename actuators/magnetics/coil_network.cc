#include "actuators/magnetics/coil_network.h"

#include <algorithm>
#include <cmath>

#include "core/base/index.h"

namespace ambrig {

namespace {}  // namespace

CoilNetwork::CoilNetwork(const StatorLanes& lanes) : reluctance_(lanes.reluctance) {
  const int per_pole = lanes.coupling == Coupling::kSides ? 2 : 1;
  floating_ = lanes.coupling == Coupling::kFloatingRotor;
  coils = lanes.coils;
  poles_ = coils / per_pole;
  for (int j = 0; j < coils; ++j) {
    Winding w;
    w.pole = j / per_pole;
    w.coil = j;
    w.n = lanes.n[j];
    w.leakage = lanes.leakage[j];
    w.resistance = lanes.resistance[j];
    windings.push_back(w);
    const std::size_t p = AsSize(w.pole);
    dx_[p] = lanes.direction_x[j];
    dy_[p] = lanes.direction_y[j];
    gap_[p] = lanes.gap_offset[j];
  }
}

std::size_t CoilNetwork::ReserveLoop(int coil) {
  Winding w = windings[AsSize(coil)];
  w.coil = -1;
  w.live = false;
  windings.push_back(w);
  return windings.size() - 1;
}

double CoilNetwork::Gap(int pole, double x, double y) const {
  const std::size_t p = AsSize(pole);
  return std::max(gap_[p] - x * dx_[p] - y * dy_[p], kGapAtPole * reluctance_.gap0);
}

void CoilNetwork::Solve(const double* lambda, double x, double y, NetworkState& s) const {
  std::array<double, kLanes> own{}, m{}, G{}, pull{};
  for (std::size_t w = 0; w < windings.size(); ++w) {
    const Winding& k = windings[w];
    if (!Carries(k)) continue;
    own[AsSize(k.pole)] += k.n * k.n / k.leakage;
    m[AsSize(k.pole)] += k.n * lambda[w] / k.leakage;
  }
  double sum_G = 0, sum_Gm = 0;
  for (int q = 0; q < poles_; ++q) {
    const std::size_t p = AsSize(q);
    const double g = Gap(q, x, y);
    G[p] = 1 / (reluctance_.Value(g) + own[p]);
    pull[p] = 0.5 * reluctance_.Pull(g);
    sum_G += G[p];
    sum_Gm += G[p] * m[p];
  }
  const double potential = floating_ ? sum_Gm / sum_G : 0;
  s.fx = s.fy = 0;
  for (int q = 0; q < poles_; ++q) {
    const std::size_t p = AsSize(q);
    s.phi[p] = G[p] * (m[p] - potential);
    const double f = pull[p] * s.phi[p] * s.phi[p];
    s.fx += f * dx_[p];
    s.fy += f * dy_[p];
  }
  for (std::size_t w = 0; w < windings.size(); ++w) {
    const Winding& k = windings[w];
    s.i[w] = Carries(k) ? (lambda[w] - k.n * s.phi[AsSize(k.pole)]) / k.leakage : 0;
  }
}

void CoilNetwork::Rates(const NetworkState& s, const double* slope, double x, double y, double vx,
                        double vy, NetworkRates& r) const {
  std::array<double, kLanes> own{}, m{}, G{};
  for (std::size_t w = 0; w < windings.size(); ++w) {
    const Winding& k = windings[w];
    if (!Carries(k)) continue;
    own[AsSize(k.pole)] += k.n * k.n / k.leakage;
    m[AsSize(k.pole)] += k.n * slope[w] / k.leakage;
  }
  double sum_G = 0, sum_Gm = 0;
  for (int q = 0; q < poles_; ++q) {
    const std::size_t p = AsSize(q);
    const double g = Gap(q, x, y);
    G[p] = 1 / (reluctance_.Value(g) + own[p]);
    m[p] += s.phi[p] * reluctance_.Slope(g) * (vx * dx_[p] + vy * dy_[p]);  // g' = -v·d
    sum_G += G[p];
    sum_Gm += G[p] * m[p];
  }
  const double potential = floating_ ? sum_Gm / sum_G : 0;
  for (int q = 0; q < poles_; ++q) r.phi[AsSize(q)] = G[AsSize(q)] * (m[AsSize(q)] - potential);
  for (std::size_t w = 0; w < windings.size(); ++w) {
    const Winding& k = windings[w];
    r.i[w] = Carries(k) ? (slope[w] - k.n * r.phi[AsSize(k.pole)]) / k.leakage : 0;
  }
}

void CoilNetwork::Linkages(const double* current, double x, double y, double* lambda) const {
  std::array<double, kLanes> mmf{}, P{};
  for (std::size_t w = 0; w < windings.size(); ++w)
    if (windings[w].live) mmf[AsSize(windings[w].pole)] += windings[w].n * current[w];
  double top = 0, sum = 0;
  for (int q = 0; q < poles_; ++q) {
    P[AsSize(q)] = 1 / reluctance_.Value(Gap(q, x, y));
    top += P[AsSize(q)] * mmf[AsSize(q)];
    sum += P[AsSize(q)];
  }
  const double potential = floating_ ? top / sum : 0;
  for (std::size_t w = 0; w < windings.size(); ++w) {
    const std::size_t p = AsSize(windings[w].pole);
    lambda[w] = windings[w].n * P[p] * (mmf[p] - potential) + windings[w].leakage * current[w];
  }
}

void CoilNetwork::Short(int coil, int loop, double s, double r, const NetworkState& now,
                        double* lambda) {
  Winding& w = windings[AsSize(coil)];
  const double phi = now.phi[AsSize(w.pole)], current = now.i[AsSize(coil)];
  if (loop >= 0) {
    Winding& l = windings[AsSize(loop)];
    l.pole = w.pole;
    l.n = s * w.n;
    l.leakage = s * s * w.leakage;
    l.resistance = s * w.resistance + r;
    l.live = true;
    lambda[loop] = l.n * phi + l.leakage * current;
  }
  w.n *= 1 - s;
  w.leakage *= (1 - s) * (1 - s);
  w.resistance *= 1 - s;
  lambda[coil] = w.n * phi + w.leakage * current;
}

double CoilNetwork::FieldEnergy(const NetworkState& s, double x, double y) const {
  double energy = 0;
  for (std::size_t w = 0; w < windings.size(); ++w)
    energy += 0.5 * windings[w].leakage * s.i[w] * s.i[w];
  for (int q = 0; q < poles_; ++q)
    energy += 0.5 * reluctance_.Value(Gap(q, x, y)) * s.phi[AsSize(q)] * s.phi[AsSize(q)];
  return energy;
}

}  // namespace ambrig
