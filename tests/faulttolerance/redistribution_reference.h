#pragma once
/// Independent evaluation of the bearing's force from the fluxes of base_model.md section 2, any
/// rotor position, without the quadratic forms under test.
#include <cmath>

#include "core/math/constants.h"
#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

/// The reference bearing, first pole at `first_angle` [rad].
inline RedistributionProblem MakeRedistributionProblem(double first_angle, const char* winding) {
  RadialStatorParameters s;
  s.turns = 50;
  s.pole_area = 2.0372e-4;
  s.gap = 4e-4;
  s.leakage_inductance = 3.5e-4;
  s.resistance = 0.5;
  s.first_pole_angle_deg = first_angle * 180 / kPi;
  s.winding = winding;
  return RedistributionProblemOf(s);
}

}  // namespace ambrig

namespace ambrig::testing_reference {

inline Eigen::Vector2d DirectForce(const RedistributionProblem& p, const CoilVector& i,
                                   const Eigen::Vector2d& r) {
  double sum_P = 0, sum_Pm = 0;
  CoilVector P, m;
  for (int j = 0; j < 8; ++j) {
    const double gap = p.gap - r.x() * std::cos(p.angle[j]) - r.y() * std::sin(p.angle[j]);
    P[j] = kMu0 * p.pole_area / gap;
    m[j] = p.turns * p.turns_left[j] * p.sign[j] * i[j];
    sum_P += P[j];
    sum_Pm += P[j] * m[j];
  }
  Eigen::Vector2d force(0, 0);
  for (int j = 0; j < 8; ++j) {
    const double phi = P[j] * (m[j] - sum_Pm / sum_P);
    const double pull = phi * phi / (2 * kMu0 * p.pole_area);
    force += pull * Eigen::Vector2d(std::cos(p.angle[j]), std::sin(p.angle[j]));
  }
  return force;
}

}  // namespace ambrig::testing_reference
