#include "rig/parameters/bearing_kind.h"

namespace ambrig {

const BearingKind* FindBearingKind(std::string_view name) {
  for (const BearingKind* k : BearingKinds())
    if (k->name == name) return k;
  return nullptr;
}

std::string BearingKindNames() {
  std::string names;
  for (const BearingKind* k : BearingKinds())
    names += (names.empty() ? "" : ", ") + std::string(k->name);
  return names;
}

std::string DropLostCoils(const BearingParameters& b, const CoilVector& turns_left,
                          CurrentMap& map) {
  for (int j = 0; j < b.coils(); ++j)
    if (turns_left[j] == 0) map.W.row(j).setZero();
  return "none";
}

std::vector<std::string> BearingParameters::Axes() const { return kind->axes(*this); }
int BearingParameters::coils() const { return kind->coils(*this); }

}  // namespace ambrig
