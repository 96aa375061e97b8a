#pragma once
/// How a run begins, the same in every fidelity. Source: docs/theory/base_model.md section 3.
#include "control/current/bearing_control.h"
#include "rig/true_rig.h"
#include "rotor/linear/force_term.h"
#include "scenarios/scenario.h"

namespace ambrig {

inline constexpr double kLevitatedWarmUp = 0.25, kClampedWarmUp = 0.03;  // before t = 0 [s]

/// Integrals that hold the set-points in coils of the nominal resistance.
void HoldSetPoints(const NominalRig& nominal, std::vector<BearingControl>& control);
/// Set-points and integrals that give these forces per axis [N]; returns their sum across the shaft
/// [N], which the base carries.
PlanePoint StartWithForces(const NominalRig& nominal, const std::vector<double>& force,
                           std::vector<BearingControl>& control);
/// Everything switched on at t = 0: no set-points, integrals at the lower limit.
void SwitchOn(std::vector<BearingControl>& control);
/// Rigid rotor through the centres that the scenario gives: x(z) = q0 + q4 z, y(z) = q1 - q3 z,
/// least squares over the radial bearings.
void PlaceClamped(const TrueRig& rig, const Scenario& scenario, MotionState& s);

}  // namespace ambrig
