#include "discovery/search/visible_size.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "discovery/search/linear_judge.h"

namespace ambrig {

std::vector<VisibleSize> VisibleSizes(const CaseModel& model, const FitResult& base,
                                      double effective_sample_size, SignatureBank& bank) {
  const LinearJudge judge(model, base, bank, effective_sample_size);
  std::vector<std::pair<double, VisibleSize>> all;
  for (const SignatureBank::Entry& entry : bank.entries()) {
    const ProbeGroup& g = entry.group;
    if (!g.linear || g.narrow || base.hypothesis.Holds(g.probes[0])) continue;
    for (Eigen::Index k = 0; k < entry.count(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const EffectParameter& p = g.probes[i].table[g.rows[i]];
      const double usual = std::abs(g.probes[i].values[g.rows[i]] - p.null_value),
                   least = judge.LeastVisible(entry, k);
      const VisibleSize v = {g.probes[i].name, g.probes[i].target, p.name, p.unit, least * usual};
      if (std::none_of(all.begin(), all.end(), [&](const auto& o) {
            return o.second.effect == v.effect && o.second.target == v.target &&
                   o.second.parameter == v.parameter;
          }))
        all.emplace_back(least, v);
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<VisibleSize> out;
  for (const auto& [share, v] : all) out.push_back(v);
  return out;
}

}  // namespace ambrig
