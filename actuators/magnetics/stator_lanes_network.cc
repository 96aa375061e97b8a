/// The general path of the lanes for any stator: the same targets λ*, solved over the whole circuit.
///
///   (Nᵀ A N + L_l + R h/2) i = λ* - λ_magnets      of the coils that carry
///
/// A (poles x (coils + 1)) are the pole fluxes per ampere; they run linearly from the start of a
/// period to its end, as the shaft does. A coil that effects or faults left with fewer turns has its
/// column scaled; a loop of shorted turns is a column of its own, the same share on every pole of the
/// coil.
#include <cmath>

#include "actuators/magnetics/stator_lanes.h"

namespace ambrig {

namespace {

/// Share of the coil's turns that are left.
double ShareOf(const StatorLanes& s, int coil) { return s.n[coil] / s.network->TurnsOf(coil); }

}  // namespace

void StatorLanes::BeginNetwork(double x0, double y0, double x1, double y1) {
  flux0_ = network->FluxAt({x0, y0, 0}).phi;
  flux1_ = x0 == x1 && y0 == y1 ? flux0_ : network->FluxAt({x1, y1, 0}).phi;
  flux_ = flux0_;
  force_start_ = network->Force(NetworkFluxes()).head<2>();
  force_end_ = force_start_;
  force_sum_.setZero();
}

void StatorLanes::PlaceNetwork(double fraction) { flux_ = flux0_ + fraction * (flux1_ - flux0_); }

WindingVector StatorLanes::NetworkCurrents() const {
  // Ampere-turns of every coil over its turns, those of its shorted loops too; then the magnets' 1.
  WindingVector current(coils + 1);
  for (int j = 0; j < coils; ++j) current[j] = ShareOf(*this, j) * i[j];
  for (const ShortedTurns& s : shorts) current[s.coil] += s.n / network->TurnsOf(s.coil) * s.i;
  current[coils] = 1;
  return current;
}

Eigen::VectorXd StatorLanes::CountedCurrents(const double* current) const {
  Eigen::VectorXd counted(coils);
  for (int j = 0; j < coils; ++j) counted[j] = ShareOf(*this, j) * current[j];
  return counted;
}

PoleVector StatorLanes::NetworkFluxes() const { return flux_ * NetworkCurrents(); }

void StatorLanes::SolveNetwork(const Lane& target, double h) {
  const WindingMatrix own = network->Linkage(flux_);  // coils x (coils + 1), without leakage
  struct Carrier {
    int coil;
    double share, diagonal, target;
  };
  std::array<Carrier, kMostWindings> carriers;
  Eigen::Index m = 0;
  std::array<Eigen::Index, kLanes> row{};
  for (int j = 0; j < coils; ++j) {
    row[static_cast<std::size_t>(j)] = -1;
    if (blocked[j]) continue;
    row[static_cast<std::size_t>(j)] = m;
    carriers[static_cast<std::size_t>(m++)] = {j, ShareOf(*this, j), 1 / inverse_l_[j], target[j]};
  }
  const Eigen::Index driven = m;
  for (const ShortedTurns& s : shorts)
    carriers[static_cast<std::size_t>(m++)] = {s.coil, s.n / network->TurnsOf(s.coil),
                                               s.leakage + s.theta * s.resistance * h, s.target};
  WindingMatrix L(m, m);
  WindingVector wanted(m);
  for (Eigen::Index a = 0; a < m; ++a) {
    const Carrier& p = carriers[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < m; ++b) {
      const Carrier& q = carriers[static_cast<std::size_t>(b)];
      L(a, b) = p.share * q.share * own(p.coil, q.coil);
    }
    L(a, a) += p.diagonal;
    wanted[a] = p.target - p.share * own(p.coil, coils);
  }
  const WindingVector current = m > 0 ? WindingVector(L.llt().solve(wanted)) : wanted;
  for (int j = 0; j < coils; ++j) {
    const Eigen::Index at = row[static_cast<std::size_t>(j)];
    i[j] = at < 0 ? 0 : current[at];
  }
  for (std::size_t k = 0; k < shorts.size(); ++k)
    shorts[k].i = current[driven + static_cast<Eigen::Index>(k)];
  // Mean flux through a coil's turns: what its linkage without leakage is made of.
  const WindingVector linkage = own * NetworkCurrents();
  for (int j = 0; j < coils; ++j) phi[j] = linkage[j] / network->TurnsOf(j);
}

void StatorLanes::TakeNetwork() {
  for (int j = 0; j < coils; ++j) lambda[j] = n[j] * phi[j] + leakage[j] * i[j];
  force_end_ = network->Force(NetworkFluxes()).head<2>();
  force_sum_ += force_end_;
}

void StatorLanes::SettleNetwork(double x, double y) {
  flux_ = network->FluxAt({x, y, 0}).phi;
  for (ShortedTurns& s : shorts) s.i = 0;
  const WindingVector linkage = network->Linkage(flux_) * NetworkCurrents();
  for (int j = 0; j < coils; ++j) phi[j] = linkage[j] / network->TurnsOf(j);
}

}  // namespace ambrig
