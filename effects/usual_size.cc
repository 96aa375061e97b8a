#include "effects/usual_size.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

EffectInstance AtUsualSize(const EffectDescription& d, const std::string& target) {
  EffectInstance e = MakeInstance(d, target);
  for (std::size_t k = 0; k < d.parameters.size(); ++k) {
    const EffectParameter& p = d.parameters[k];
    if (!d.Switches(p) && p.null_value != 0 && std::isfinite(p.null_value)) continue;
    if (!d.Switches(p) && p.null_value == 0) continue;
    const double size = p.typical_lo > 0 ? std::sqrt(p.typical_lo * p.typical_hi)
                                         : 0.5 * (p.typical_lo + p.typical_hi);
    e.values[k] = std::isinf(p.null_value) ? size : std::clamp(p.null_value + size, p.lo, p.hi);
  }
  return e;
}

}  // namespace ambrig
