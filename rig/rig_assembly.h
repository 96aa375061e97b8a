#pragma once
/// Assembly: a plant (the true rig) from parameters and the effects named in the rig file.
#include "effects/plant.h"
#include "rig/rig_figures.h"
#include "rig/true_rig.h"

namespace ambrig {

struct LinearRotor;  // rotor/linear/linear_rotor.h

/// Effects whose parameters are all null are dropped, so that null means the same bits.
Plant BuildPlant(const TrueRig& true_rig);

/// The rotor's linear equations at `speed` [rad/s] with one port per bearing, in the plant's order.
LinearRotor LinearRotorOf(const Plant& plant, double speed = 0);

}  // namespace ambrig
