#include "effects/catalogue.h"

#include <fmt/format.h>

#include "core/base/errors.h"

// The one written list, in the order of docs/effects.md.
#define AMBRIG_EFFECTS(EFFECT) \
  EFFECT(IronReluctance)       \
  EFFECT(Saturation)           \
  EFFECT(Hysteresis)           \
  EFFECT(EddyCurrents)         \
  EFFECT(EddySleeve)           \
  EFFECT(BhCurve)              \
  EFFECT(EddyImpedance)        \
  EFFECT(PlayHysteresis)       \
  EFFECT(Fringing)             \
  EFFECT(MagneticOffset)       \
  EFFECT(TurnMismatch)         \
  EFFECT(CopperHeating)        \
  EFFECT(BusImpedance)         \
  EFFECT(FreewheelDrop)        \
  EFFECT(AmplifierOffset)      \
  EFFECT(DeadTime)             \
  EFFECT(CurrentSensorGain)    \
  EFFECT(CurrentSensorOffset)  \
  EFFECT(LoopDelay)            \
  EFFECT(SensorGain)           \
  EFFECT(SensorOffset)         \
  EFFECT(SensorRotation)       \
  EFFECT(SensorLowpass)        \
  EFFECT(SensorRunout)         \
  EFFECT(SensorHum)            \
  EFFECT(Unbalance)            \
  EFFECT(ShaftBow)             \
  EFFECT(BendingModeEffect)    \
  EFFECT(RotatingDamping)      \
  EFFECT(CrossCoupling)        \
  EFFECT(SidePull)             \
  EFFECT(CouplingMisalignment) \
  EFFECT(Windage)              \
  EFFECT(BaseMode)             \
  EFFECT(BaseVibration)        \
  EFFECT(ConstantLoad)         \
  EFFECT(ContactFriction)      \
  EFFECT(ContactMount)         \
  EFFECT(Formula)

namespace ambrig {

#define AMBRIG_DECLARE(name) EffectDescription name();
AMBRIG_EFFECTS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

const std::vector<EffectDescription>& Catalogue() {
#define AMBRIG_MAKE(name) name(),
  static const std::vector<EffectDescription> all = {AMBRIG_EFFECTS(AMBRIG_MAKE)};
#undef AMBRIG_MAKE
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
  throw InputError(fmt::format("unknown effect {}{}, allowed: {}", id,
                               near.empty() ? "" : ", did you mean " + near + "?", all));
}

}  // namespace ambrig
