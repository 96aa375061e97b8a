#pragma once
/// Effects of sensors, rotor, process, base and contact, and the user's own formula; one file each,
/// named by its id. Laws, sources and limits stand in the sources; docs/effects.md lists them all.
#include "effects/effect.h"

namespace ambrig {

// Position sensors
EffectDescription SensorGain();
EffectDescription SensorOffset();
EffectDescription SensorRotation();
EffectDescription SensorLowpass();
EffectDescription SensorRunout();
EffectDescription SensorHum();
// Rotor
EffectDescription Unbalance();
EffectDescription ShaftBow();
EffectDescription BendingModeEffect();
EffectDescription RotatingDamping();
// Process
EffectDescription CrossCoupling();
EffectDescription SidePull();
EffectDescription CouplingMisalignment();
EffectDescription Windage();
EffectDescription ConstantLoad();
// Base
EffectDescription BaseMode();
EffectDescription BaseVibration();
// Auxiliary bearings
EffectDescription ContactFriction();
EffectDescription ContactMount();
// Written by the user
EffectDescription Formula();

}  // namespace ambrig
