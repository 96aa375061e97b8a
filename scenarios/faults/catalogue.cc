/// The catalogue of faults: one line per file of this folder.
#include "core/base/errors.h"
#include "scenarios/faults/fault.h"

// In the order of the documentation.
#define AMBRIG_FAULTS(FAULT) \
  FAULT(OpenCoil)            \
  FAULT(PartialShort)        \
  FAULT(AmplifierOff)        \
  FAULT(SwitchStuckOn)       \
  FAULT(CurrentSensorFault)  \
  FAULT(PositionSensorFault) \
  FAULT(BusSag)

namespace ambrig {

#define AMBRIG_DECLARE(name) const Fault& name();
AMBRIG_FAULTS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

std::span<const Fault* const> Faults() {
#define AMBRIG_ADDRESS(name) &name(),
  static const Fault* const all[] = {AMBRIG_FAULTS(AMBRIG_ADDRESS)};
#undef AMBRIG_ADDRESS
  return all;
}

const Fault& FaultByKind(std::string_view kind) {
  for (const Fault* f : Faults())
    if (f->kind == kind) return *f;
  Require(false, "a kind of fault of the catalogue");
  return *Faults().front();
}

}  // namespace ambrig
