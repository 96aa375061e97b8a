#pragma once
/// The trial sizes of an effect: where its signature is taken.
#include <vector>

#include "discovery/screen.h"

namespace ambrig {

/// Probes that belong together. In a linear group every probe moves one parameter from its null and
/// their signatures add; otherwise the group is one probe of finite size, to be scaled about 1.
struct ProbeGroup {
  std::vector<EffectInstance> probes;
  std::vector<std::size_t> rows;       // linear: the table row that each probe moved
  bool linear = true;
};

std::vector<ProbeGroup> ProbesOf(const EffectDescription& d, const std::string& target, const CaseModel& model,
                                 const std::vector<double>& residual);

}  // namespace ambrig
