#include "rig/rig_figures.h"

#include <algorithm>
#include <cmath>

#include "control/interface/controller_kind.h"
#include "core/base/coil_name.h"
#include "core/math/line_weights.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

EffectTargets TargetsOfEffects(const RigParameters& rig) {
  EffectTargets known;
  for (const ShaftPlane& s : rig.stations) known.stations.push_back(s.name);
  for (const auto& b : rig.bearings) {
    known.planes.push_back(b.kind->axial ? "z" : b.name);
    known.bearings.push_back(b.name);
    for (int j = 0; j < b.coils(); ++j) known.coils.push_back(CoilName(b.name, j));
    for (const auto& axis : b.Axes()) known.axes.push_back(axis);
    const unsigned kind =
        b.kind->acts_on | (PoleByPole(b.kind->stator(b)) ? unsigned{kOnPoleByPole} : 0U);
    known.kind[b.name] = known.kind[known.planes.back()] = kind;
    for (int j = 0; j < b.coils(); ++j) known.kind[CoilName(b.name, j)] = kind;
    for (const auto& axis : b.Axes()) known.kind[axis] = kind;
  }
  return known;
}

double ForceConstant(const BearingParameters& b) { return b.kind->force_constant(b); }

double BiasCurrent(const RigParameters& rig, const BearingParameters& b) {
  const double own = b.kind->own_bias(b);
  return std::isnan(own) ? rig.controller.bias_current : own;
}

std::vector<int> CoilsOf(const RigParameters& rig) {
  std::vector<int> out;
  for (const BearingParameters& b : rig.bearings) out.push_back(b.coils());
  return out;
}

const PidParameters& PidOf(const RigParameters& rig, const BearingParameters& b) {
  return b.controller ? *b.controller : rig.controller.pid;
}

std::vector<std::array<double, 2>> CoilDirections(const BearingParameters& b) {
  return b.kind->stator(b).Directions();
}

double LargestInductance(const BearingParameters& b) {
  const StatorGeometry g = b.kind->stator(b);
  WindingMatrix all;
  if (g.network) all = g.network->Linkage(g.network->FluxAt(Eigen::Vector3d::Zero()).phi);
  double total = 0, most = 0;
  const auto P = [&](int j) { return 1 / g.reluctance.Value(g.gap_offset[j]); };
  for (int j = 0; j < g.coils; ++j) total += P(j);
  for (int j = 0; j < g.coils; ++j) {
    const double floating = g.coupling == Coupling::kFloatingRotor ? 1 - P(j) / total : 1;
    const double own = g.network ? all(j, j) : g.n[j] * g.n[j] * P(j) * floating;
    most = std::max(most, own + g.leakage[j]);
  }
  return most;
}

double LeastInductance(const BearingParameters& b) {
  const StatorGeometry g = b.kind->stator(b);
  if (!g.network)  // patterns without flux, or coils by themselves
    return g.coupling == Coupling::kNone ? LargestInductance(b) : g.leakage[0];
  Eigen::MatrixXd L =
      g.network->Linkage(g.network->FluxAt(Eigen::Vector3d::Zero()).phi).leftCols(g.coils);
  for (int j = 0; j < g.coils; ++j) L(j, j) += g.leakage[j];
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(L, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

double CoilResistance(const BearingParameters& b) { return b.kind->stator(b).resistance[0]; }

std::vector<double> RadialShares(const RigParameters& rig) {
  std::vector<double> places;
  for (const auto& b : rig.bearings)
    if (b.kind->two_axes) places.push_back(b.z);
  return LineWeights(places, 0);
}

std::vector<std::array<double, 2>> WeightShares(const RigParameters& rig) {
  const std::vector<double> shares = RadialShares(rig);
  std::size_t radial = 0;
  std::vector<std::array<double, 2>> out;
  const double m = rig.rotor.mass;
  for (const auto& b : rig.bearings) {
    if (b.kind->two_axes) {
      const double share = shares[radial++];
      out.push_back({-m * rig.gravity[0] * share, -m * rig.gravity[1] * share});
    } else {
      const std::array<double, 3> axis = b.kind->axis(b), &g = rig.gravity;
      out.push_back({-m * (g[0] * axis[0] + g[1] * axis[1] + g[2] * axis[2]), 0});
    }
  }
  return out;
}

double RecordRateFor(const RigParameters& rig, double rate) {
  const double pwm = rig.amplifier.switching_frequency;
  const int k = rig.samples_per_period();
  if (rate <= pwm * (1 + 1e-9)) return pwm / std::max(1.0, std::floor(pwm / rate + 1e-6));
  for (int part = 2; part <= k; ++part)
    if (k % part == 0 && pwm * part >= rate * (1 - 1e-9)) return pwm * part;
  return pwm * k;
}

std::vector<double> WeightOverAxes(const RigParameters& rig) {
  std::vector<double> force;
  const auto shares = WeightShares(rig);
  for (std::size_t k = 0; k < rig.bearings.size(); ++k)
    for (std::size_t side = 0; side < rig.bearings[k].Axes().size(); ++side)
      force.push_back(shares[k][side]);
  return force;
}

std::vector<std::string> DesignedControllers(const RigParameters& rig) {
  std::vector<std::string> names;
  if (ControllerKindByName(rig.controller.kind).designed) names.push_back("main");
  for (const ControllerParameters& c : rig.other_controllers)
    if (ControllerKindByName(c.kind).designed) names.push_back(c.name);
  return names;
}

}  // namespace ambrig
