/// The kinds of bearing: one line per file of this folder.
#include "rig/bearing_kinds/bearing_kind.h"

// In the order of BearingKind.
#define AMBRIG_BEARING_KINDS(KIND) \
  KIND(RadialBearing)              \
  KIND(ThrustBearing)              \
  KIND(OpposedBearing)

namespace ambrig {

#define AMBRIG_DECLARE(name) const BearingKindTable& name();
AMBRIG_BEARING_KINDS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

std::span<const BearingKindTable* const> BearingKinds() {
#define AMBRIG_ADDRESS(name) &name(),
  static const BearingKindTable* const all[] = {AMBRIG_BEARING_KINDS(AMBRIG_ADDRESS)};
#undef AMBRIG_ADDRESS
  return all;
}

const BearingKindTable& TableOf(BearingKind kind) {
  return *BearingKinds()[static_cast<std::size_t>(kind)];
}

std::string BearingKindNames() {
  std::string names;
  for (const BearingKindTable* k : BearingKinds())
    names += (names.empty() ? "" : ", ") + std::string(k->name);
  return names;
}

std::vector<std::string> BearingParameters::Axes() const { return TableOf(kind).axes(*this); }

}  // namespace ambrig
