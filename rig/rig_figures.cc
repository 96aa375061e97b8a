#include "rig/rig_figures.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {
unsigned ActsOnBit(BearingKind kind) {
  return kind == BearingKind::kRadial   ? kOnRadial
         : kind == BearingKind::kThrust ? kOnThrust
                                        : kOnOpposed;
}
}  // namespace

EffectTargets TargetsOfEffects(const RigParameters& rig) {
  EffectTargets known;
  for (const ShaftPlane& s : rig.stations) known.stations.push_back(s.name);
  for (const auto& b : rig.bearings) {
    known.planes.push_back(b.kind == BearingKind::kThrust ? "z" : b.name);
    known.bearings.push_back(b.name);
    for (int j = 1; j <= b.coils(); ++j)
      known.coils.push_back(b.name + ".coil" + std::to_string(j));
    for (const auto& axis : b.Axes()) known.axes.push_back(axis);
    const unsigned kind = ActsOnBit(b.kind);
    known.kind[b.name] = known.kind[known.planes.back()] = kind;
    for (int j = 1; j <= b.coils(); ++j) known.kind[b.name + ".coil" + std::to_string(j)] = kind;
    for (const auto& axis : b.Axes()) known.kind[axis] = kind;
  }
  return known;
}

double ForceConstant(const BearingParameters& b) {
  switch (b.kind) {
    case BearingKind::kRadial:
      return RadialStator(b.radial).ForceConstant();
    case BearingKind::kThrust:
      return 4 * kMu0 * b.thrust.turns * b.thrust.turns * b.thrust.pole_area /
             (b.thrust.gap * b.thrust.gap);
    case BearingKind::kOpposed: {
      // f = (1/2) (c0 + v)² L' - (1/2) (c0 - v)² L' = 2 c0 v L', one coil alone: c0 v L' about c0.
      const auto& p = b.opposed;
      const double slope =
          p.inductance_near / (p.gap_constant * std::pow(1 + p.gap / p.gap_constant, 2));
      return (p.coils > 1 ? 2 : 1) * slope;
    }
  }
  return 0;
}

double BiasCurrent(const RigParameters& rig, const BearingParameters& b) {
  if (b.kind == BearingKind::kThrust) return b.thrust.bias_current;
  if (b.kind == BearingKind::kOpposed && b.opposed.bias_current > 0) return b.opposed.bias_current;
  return rig.controller.bias_current;
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
  std::vector<std::array<double, 2>> out;
  switch (b.kind) {
    case BearingKind::kRadial: {
      const RadialStator stator(b.radial);
      for (int j = 0; j < kPoles; ++j) out.push_back({stator.cosine()[j], stator.sine()[j]});
      break;
    }
    case BearingKind::kThrust:
      for (int j = 0; j < kThrustCoils; ++j) out.push_back({j < 2 ? 1.0 : -1.0, 0});
      break;
    case BearingKind::kOpposed:
      for (int j = 0; j < b.coils(); ++j) out.push_back({j == 0 ? 1.0 : -1.0, 0});
      break;
  }
  return out;
}

double CoilResistance(const BearingParameters& b) {
  switch (b.kind) {
    case BearingKind::kRadial:
      return b.radial.resistance;
    case BearingKind::kThrust:
      return b.thrust.resistance;
    case BearingKind::kOpposed:
      return b.opposed.resistance;
  }
  return 0;
}

std::vector<std::array<double, 2>> WeightShares(const RigParameters& rig) {
  // Least-norm forces f_k with Σ f = -m g and Σ z f = 0; exact for two bearings.
  double n = 0, sz = 0, szz = 0;
  for (const auto& b : rig.bearings)
    if (b.kind == BearingKind::kRadial) {
      n += 1;
      sz += b.z;
      szz += b.z * b.z;
    }
  std::vector<std::array<double, 2>> out;
  const double m = rig.rotor.mass;
  for (const auto& b : rig.bearings) {
    if (b.kind == BearingKind::kRadial) {
      const double share = (szz - b.z * sz) / (n * szz - sz * sz);
      out.push_back({-m * rig.gravity[0] * share, -m * rig.gravity[1] * share});
    } else if (b.kind == BearingKind::kThrust) {
      out.push_back({-m * rig.gravity[2], 0});
    } else {
      const double a = b.opposed.angle_deg * kPi / 180;
      out.push_back({-m * (rig.gravity[0] * std::cos(a) + rig.gravity[1] * std::sin(a)), 0});
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

}  // namespace ambrig
