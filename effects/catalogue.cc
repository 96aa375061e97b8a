#include "effects/catalogue.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "effects/effects_magnetic.h"
#include "effects/effects_motion.h"

namespace ambrig {

/// The one written list, in the order of docs/effects.md.
const std::vector<EffectDescription>& Catalogue() {
  static const std::vector<EffectDescription> all = {
      IronReluctance(),    Saturation(),
      Hysteresis(),        EddyCurrents(),
      Fringing(),          MagneticOffset(),
      TurnMismatch(),      CopperHeating(),
      BusImpedance(),      FreewheelDrop(),
      AmplifierOffset(),   DeadTime(),
      CurrentSensorGain(), CurrentSensorOffset(),
      LoopDelay(),         SensorGain(),
      SensorOffset(),      SensorRotation(),
      SensorLowpass(),     SensorRunout(),
      SensorHum(),         Unbalance(),
      ShaftBow(),          BendingModeEffect(),
      RotatingDamping(),   CrossCoupling(),
      SidePull(),          CouplingMisalignment(),
      Windage(),           BaseMode(),
      BaseVibration(),     ConstantLoad(),
      ContactFriction(),   ContactMount(),
      Formula(),
  };
  return all;
}

const EffectDescription* FindEffect(const std::string& id) {
  for (const EffectDescription& d : Catalogue())
    if (d.id == id) return &d;
  return nullptr;
}

const EffectDescription& EffectNamed(const std::string& id) {
  if (const EffectDescription* d = FindEffect(id)) return *d;
  std::string all;
  for (const EffectDescription& d : Catalogue()) all += (all.empty() ? "" : ", ") + d.id;
  const std::string near = Nearest(id, all);
  throw InputError(fmt::format("{} is no effect{}, allowed: {}", id,
                               near.empty() ? "" : ", did you mean " + near + "?", all));
}

}  // namespace ambrig
