#pragma once
/// Parameters of a rigid rotor.
#include "core/base/parameters.h"

namespace ambrig {

struct RotorParameters {
  double mass = kRequired;
  double inertia_transverse = kRequired;
  double inertia_polar = kRequired;
  double journal_radius = kRequired;
};

inline constexpr Field<RotorParameters> kRotorFields[] = {
    {"mass", &RotorParameters::mass, "kg", 1e-6, 1e6, "m"},
    {"inertia_transverse", &RotorParameters::inertia_transverse, "kg m2", 1e-12, 1e6,
     "It, about the centre of mass"},
    {"inertia_polar", &RotorParameters::inertia_polar, "kg m2", 0, 1e6, "Ip, about the spin axis"},
    {"journal_radius", &RotorParameters::journal_radius, "m", 1e-4, 10,
     "at the auxiliary bearings"},
};

}  // namespace ambrig
