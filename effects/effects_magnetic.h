#pragma once
/// Effects of iron, coils, amplifiers, bus and current measurement; one file each, named by its id.
/// Laws, sources and limits stand in the sources; docs/effects.md lists them all.
#include "effects/effect.h"

namespace ambrig {

// Iron and geometry
EffectDescription IronReluctance();
EffectDescription Saturation();
EffectDescription Hysteresis();
EffectDescription EddyCurrents();
EffectDescription Fringing();
EffectDescription MagneticOffset();
// Coils
EffectDescription TurnMismatch();
EffectDescription CopperHeating();
// Electronics
EffectDescription BusImpedance();
EffectDescription FreewheelDrop();
EffectDescription AmplifierOffset();
EffectDescription DeadTime();
EffectDescription CurrentSensorGain();
EffectDescription CurrentSensorOffset();
EffectDescription LoopDelay();

}  // namespace ambrig
