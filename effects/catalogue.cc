#include "effects/catalogue.h"

namespace ambrig {

const std::vector<EffectDescription>& Catalogue() {
  static const std::vector<EffectDescription> all = {};
  return all;
}

const EffectDescription* FindEffect(const std::string& id) {
  for (const EffectDescription& d : Catalogue())
    if (d.id == id) return &d;
  return nullptr;
}

}  // namespace ambrig
