#pragma once
/// Figures that follow from the parameters of a rig alone, without a plant.
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Targets that effects of this rig may have.
EffectTargets TargetsOfEffects(const RigParameters& rig);

/// Nominal force constant k of a bearing: f = k c0 v. [N/A²]
double ForceConstant(const BearingParameters& b);
/// Bias current c0 of a bearing. [A]
double BiasCurrent(const RigParameters& rig, const BearingParameters& b);
/// Coils of each bearing.
std::vector<int> CoilsOf(const RigParameters& rig);
/// PID of a bearing's axes.
const PidParameters& PidOf(const RigParameters& rig, const BearingParameters& b);
/// Directions in which the coils of a bearing pull: (x, y) per coil, along the axis of a thrust or
/// an opposed bearing (1, 0) or (-1, 0).
std::vector<std::array<double, 2>> CoilDirections(const BearingParameters& b);
/// Largest own inductance of its coils, rotor centred [H].
double LargestInductance(const BearingParameters& b);
/// Least inductance that a pattern of its coils' currents sees, rotor centred [H].
double LeastInductance(const BearingParameters& b);
/// Resistance of one coil [ohm].
double CoilResistance(const BearingParameters& b);
/// Shares of the radial bearings in a load across the shaft at the centre of mass [-].
std::vector<double> RadialShares(const RigParameters& rig);
/// Bearing forces (fx, fy) that carry the rotor's weight, one per bearing. [N]
std::vector<std::array<double, 2>> WeightShares(const RigParameters& rig);
/// The weight's share of every axis [N].
std::vector<double> WeightOverAxes(const RigParameters& rig);
/// Controllers of the rig that a synthesis designs for its linear plant
/// (lqg, h-infinity): "main" for [controller], NAMEs of [controllers.NAME].
std::vector<std::string> DesignedControllers(const RigParameters& rig);

/// Rates at which the engine can record: the nearest one not below `rate`.
double RecordRateFor(const RigParameters& rig, double rate);

}  // namespace ambrig
