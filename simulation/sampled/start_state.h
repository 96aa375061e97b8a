#pragma once
/// How a run begins, the same in every fidelity. Source: docs/theory/base_model.md section 3.
#include "effects/plant.h"
#include "faulttolerance/supervision/supervisor.h"
#include "scenarios/scenario.h"

namespace ambrig {

inline constexpr double kLevitatedWarmUp = 0.25, kClampedWarmUp = 0.03;  // before t = 0 [s]

/// The controller's side of bearing k: healthy map of the nominal rig, one amplifier per coil.
BearingControl MakeBearingControl(const RigParameters& rig, const RigParameters& nominal,
                                  std::size_t k, const StatorLanes& lanes);
/// Integrals that hold the set-points in coils of these resistances [ohm].
void HoldSetPoints(BearingControl& control, const Lane& resistance);
/// Set-points and integrals that give these forces per axis [N], the base at rest under their
/// reaction.
void StartWithForces(const RigParameters& rig, const std::vector<double>& force, const Plant& plant,
                     std::vector<BearingControl>& control, MotionState& s);
/// Everything switched on at t = 0: no set-points, integrals at the lower limit.
void SwitchOn(std::vector<BearingControl>& control);
/// Rigid rotor through the centres that the scenario gives: x(z) = q0 + q4 z, y(z) = q1 - q3 z,
/// least squares over the radial bearings.
void PlaceClamped(const RigParameters& rig, const Scenario& scenario, MotionState& s);

}  // namespace ambrig
