#include "actuators/magnetics/stator_parameters.h"

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {

double BiasMagnet::Reluctance() const { return length / (kMu0 * mu_r * area); }

std::vector<StatorPole> PolesOf(const StatorParameters& p) {
  if (p.pattern.empty()) return p.poles;
  const StatorTemplate* pattern = FindStatorTemplate(p.pattern);
  Require(pattern != nullptr, "a template of the list");
  return pattern->expand(p);
}

int CoilsOf(const std::vector<StatorPole>& poles) {
  int coils = 0;
  for (const StatorPole& p : poles)
    for (const auto& [coil, turns] : p.turns) coils = std::max(coils, coil + 1);
  return coils;
}

std::shared_ptr<const PoleNetwork> NetworkOf(const StatorParameters& p) {
  const std::vector<StatorPole> given = PolesOf(p);
  std::vector<NetworkPole> poles;
  Eigen::MatrixXd turns =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(given.size()), CoilsOf(given));
  int parts = 0;
  for (const StatorPole& s : given) {
    NetworkPole pole;
    const double gamma = s.angle_deg * kPi / 180, cone = s.cone_deg * kPi / 180;
    pole.direction = p.axial
                         ? std::array<double, 3>{s.side, 0, 0}
                         : std::array<double, 3>{std::cos(gamma) * std::cos(cone),
                                                 std::sin(gamma) * std::cos(cone), std::sin(cone)};
    pole.area = s.area;
    pole.gap = s.gap;
    pole.part = static_cast<int>(s.plane) - 1;
    parts = std::max(parts, pole.part + 1);
    if (s.magnet) {
      pole.mmf = s.magnet->mmf;
      pole.reluctance = s.magnet->Reluctance();
    }
    for (const auto& [coil, n] : s.turns) turns(static_cast<Eigen::Index>(poles.size()), coil) = n;
    poles.push_back(pole);
  }
  std::vector<NetworkMagnet> magnets;
  if (p.bias.mmf != 0 && !p.bias_in_poles) {
    // Flux leaves the poles of plane 1 towards the rotor, and comes back by plane 2 or beside it.
    if (parts > 1)
      magnets.push_back({1, 0, p.bias.mmf, p.bias.Reluctance()});
    else
      magnets.push_back({0, NetworkMagnet::kRotor, -p.bias.mmf, p.bias.Reluctance()});
  }
  return std::make_shared<const PoleNetwork>(std::move(poles), std::move(turns),
                                             std::move(magnets));
}

StatorGeometry GeometryOf(const StatorParameters& p) {
  StatorGeometry g;
  g.coupling = Coupling::kNetwork;
  g.network = NetworkOf(p);
  g.coils = g.network->coils();
  Require(g.coils <= kLanes, "at most eight coils");
  const double gap = g.network->SmallestGap();
  double area = 0;
  for (int k = 0; k < g.network->poles(); ++k) area += g.network->pole(k).area;
  g.reluctance.per_metre = g.network->poles() / (kMu0 * area);
  g.reluctance.gap0 = gap;
  // The way in which a coil pulls: its force upon what is there already, all coils at 1 A.
  const auto J = g.network->ForceOfCurrent(Eigen::Vector3d::Zero(), Eigen::VectorXd::Ones(g.coils));
  for (int j = 0; j < g.coils; ++j) {
    g.n[j] = g.network->TurnsOf(j);
    g.leakage[j] = p.leakage_inductance;
    g.resistance[j] = p.resistance;
    const double size = J.col(j).head<2>().norm();
    g.direction_x[j] = size > 0 ? J(0, j) / size : 1;
    g.direction_y[j] = size > 0 ? J(1, j) / size : 0;
    g.gap_offset[j] = gap;
  }
  return g;
}

}  // namespace ambrig
