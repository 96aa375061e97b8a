#include "discovery/case/effect_target.h"

#include "rig/rig_assembly.h"

namespace ambrig {

void RequireTarget(const EffectDescription& d, const RigParameters& rig, const std::string& wanted,
                   const std::string& refusal) {
  std::string names;
  for (const std::string& t : TargetsOf(d, TargetsOfEffects(rig))) {
    if (t == wanted || wanted.empty()) return;
    names += (names.empty() ? "" : ", ") + t;
  }
  throw InputError(refusal + " " + (names.empty() ? "no target of this rig" : names));
}

}  // namespace ambrig
