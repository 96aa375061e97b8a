/// The kinds of bearing: one line per file of this folder.
#include "rig/parameters/bearing_kind.h"

#define AMBRIG_BEARING_KINDS(KIND) \
  KIND(RadialBearing)              \
  KIND(ThrustBearing)              \
  KIND(OpposedBearing)             \
  KIND(StatorBearing)              \
  KIND(AxialStatorBearing)

namespace ambrig {

#define AMBRIG_DECLARE(name) const BearingKind& name();
AMBRIG_BEARING_KINDS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

std::span<const BearingKind* const> BearingKinds() {
#define AMBRIG_ADDRESS(name) &name(),
  static const BearingKind* const all[] = {AMBRIG_BEARING_KINDS(AMBRIG_ADDRESS)};
#undef AMBRIG_ADDRESS
  return all;
}

}  // namespace ambrig
