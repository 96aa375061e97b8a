#pragma once
/// One axis with one or two magnets facing each other, each with a core of its own:
///
///   L(g) = L_inf + L_0/(1 + g/g_c)                                [H]
///   f    = (1/2) i_1^2 L_0 g_c/(g_c + g_1)^2 - the same of coil 2 [N]
///
/// Coil 1 pulls along the axis, coil 2 against it. A magnet is taken as one with a single turn: its
/// reluctance is (1 + g/g_c)/L_0, its leakage inductance L_inf.
/// Source: docs/theory/base_model.md section 2.
#include "core/base/parameters.h"

namespace ambrig {

struct OpposedStatorParameters {
  double angle_deg = 90;
  double gap = kRequired;
  double inductance_far = kRequired;
  double inductance_near = kRequired;
  double gap_constant = kRequired;
  double resistance = kRequired;
  double coils = 2;
  double bias_current = 0;
};

inline constexpr Field<OpposedStatorParameters> kOpposedStatorFields[] = {
    {"angle_deg", &OpposedStatorParameters::angle_deg, "deg", -360, 360,
     "direction that coil 1 pulls to"},
    {"gap", &OpposedStatorParameters::gap, "m", 1e-6, 1, "of each magnet, rotor centred"},
    {"inductance_far", &OpposedStatorParameters::inductance_far, "H", 1e-9, 1e3, "L_inf, gap open"},
    {"inductance_near", &OpposedStatorParameters::inductance_near, "H", 1e-9, 1e3,
     "L_0, added at zero gap"},
    {"gap_constant", &OpposedStatorParameters::gap_constant, "m", 1e-7, 10,
     "g_c, where L_0's part has halved"},
    {"resistance", &OpposedStatorParameters::resistance, "ohm", 1e-6, 1e4, "R, per coil"},
    {"coils", &OpposedStatorParameters::coils, "-", 1, 2, "1: only the magnet that pulls to +"},
    {"bias_current", &OpposedStatorParameters::bias_current, "A", 0, 1e4, "c0, both coils"},
};

}  // namespace ambrig
