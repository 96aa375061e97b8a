#pragma once
/// Thrust bearing: two sides (+z, -z), each a ring core with two independent windings.
///
///   phi = P N (i_1 + i_2),  P = mu0 A / (2 g),  g = g0 -/+ z     flux of one side [Wb]
///   f   = phi² / (mu0 A)                                         pull of one side [N]
///
/// Coils 1, 2 pull towards +z, coils 3, 4 towards -z. Mutual inductance of a side: N² P.
/// Source: docs/theory/base_model.md section 2.
#include "core/base/parameters.h"

namespace ambrig {

struct ThrustStatorParameters {
  double turns = kRequired;
  double pole_area = kRequired;
  double gap = kRequired;
  double leakage_inductance = kRequired;
  double resistance = kRequired;
  double bias_current = kRequired;
};

inline constexpr Field<ThrustStatorParameters> kThrustStatorFields[] = {
    {"turns", &ThrustStatorParameters::turns, "-", 1, 1e4, "N, per winding"},
    {"pole_area", &ThrustStatorParameters::pole_area, "m2", 1e-8, 1.0, "A, per ring"},
    {"gap", &ThrustStatorParameters::gap, "m", 1e-6, 1e-1, "g0, each side"},
    {"leakage_inductance", &ThrustStatorParameters::leakage_inductance, "H", 1e-9, 1.0, "L_l"},
    {"resistance", &ThrustStatorParameters::resistance, "ohm", 1e-6, 1e4, "R, per winding"},
    {"bias_current", &ThrustStatorParameters::bias_current, "A", 0, 1e3, "c0, every winding"},
};

inline constexpr int kThrustCoils = 4;

}  // namespace ambrig
