#pragma once
/// Assembly: a plant (the true rig) from parameters and the effects named in the rig file.
#include "effects/plant.h"
#include "rig/rig_parameters.h"

namespace ambrig {

struct LinearRotor;  // rotor/motion/linear_rotor.h

/// Effects whose parameters are all null are dropped, so that null means the same bits.
Plant BuildPlant(const RigParameters& rig);

/// The rotor's linear equations at `speed` [rad/s] with one port per bearing, in the plant's order.
LinearRotor LinearRotorOf(const Plant& plant, double speed = 0);

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
/// Bearing forces (fx, fy) that carry the rotor's weight, one per bearing. [N]
std::vector<std::array<double, 2>> WeightShares(const RigParameters& rig);
/// The weight's share of every axis [N].
std::vector<double> WeightOverAxes(const RigParameters& rig);

/// Rates at which the engine can record: the nearest one not below `rate`.
double RecordRateFor(const RigParameters& rig, double rate);

}  // namespace ambrig
