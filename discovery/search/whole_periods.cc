#include "discovery/search/whole_periods.h"

#include "effects/catalogue.h"

namespace ambrig {

double WholePeriodOf(const CaseModel& model, const Hypothesis& h, const FreeParameter& parameter) {
  if (parameter.effect < 0) return 0;
  const EffectInstance& e = h.rig.effects[static_cast<std::size_t>(parameter.effect)];
  const EffectDescription* d = FindEffect(e.name);
  if (!d || d->whole_periods.empty() || e.table[parameter.row].name != d->whole_periods) return 0;
  return 1 / model.data().rig.amplifier.switching_frequency;
}

}  // namespace ambrig
