#include "effects/catalogue.h"

#include "effects/effects_magnetic.h"
#include "effects/effects_motion.h"

namespace ambrig {

/// The one written list, in the order of docs/effects.md.
const std::vector<EffectDescription>& Catalogue() {
  static const std::vector<EffectDescription> all = {
      IronReluctance(),
      Saturation(),
      Hysteresis(),
      EddyCurrents(),
      Fringing(),
      MagneticOffset(),
      TurnMismatch(),
      CopperHeating(),
      BusImpedance(),
      FreewheelDrop(),
      AmplifierOffset(),
      DeadTime(),
      CurrentSensorGain(),
      CurrentSensorOffset(),
      LoopDelay(),
      SensorGain(),
      SensorOffset(),
      SensorRotation(),
      SensorLowpass(),
      SensorRunout(),
      SensorHum(),
      Unbalance(),
      ShaftBow(),
      BendingModeEffect(),
      RotatingDamping(),
      CrossCoupling(),
      SidePull(),
      CouplingMisalignment(),
      Windage(),
      BaseMode(),
      BaseVibration(),
      ConstantLoad(),
      ContactFriction(),
      ContactMount(),
      Formula(),
  };
  return all;
}

const EffectDescription* FindEffect(const std::string& id) {
  for (const EffectDescription& d : Catalogue())
    if (d.id == id) return &d;
  return nullptr;
}

}  // namespace ambrig
