#include "discovery/model/block_ratios.h"

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/model/floor.h"
#include "discovery/model/record_rows.h"

namespace ambrig {

BlockErrors BlockRatios(const CaseModel& model, const Hypothesis& h, std::size_t record) {
  const CaseRecord& r = model.data().records[record];
  if (!OverTime(r) || r.imposed != Imposed::kNothing) return {};  // it is one block alone
  Hypothesis noisy = h;
  noisy.rig = WithNoise(h.rig, model.noise_model);
  CaseRecord own = r;
  const Record simulated = model.Simulated(noisy, record, true, 21);
  own.data = AtRowsOf(r.data, simulated);
  for (Channel& c : own.data.channels) {
    if (!simulated.Find(c.name)) continue;
    const auto it = model.data().noise.find(c.name);
    if (it != model.data().noise.end() && IsOfKind(c.name, ChannelKind::kLoadCell))
      for (std::size_t k = 0; k < c.samples.size(); ++k)
        c.samples[k] += it->second * (k % 2 == 0 ? 1 : -1);
  }
  const BlockErrors measured = BlockRms(h.rig, model.data().rig, r.scenario, r.data),
                    floor = BlockRms(h.rig, model.data().rig, own.scenario, own.data);
  BlockErrors out;
  for (const auto& [block, rms] : measured) {
    const auto it = floor.find(block);
    const double least = block == "controller" ? 1e-4
                         : block == "coil"     ? 1e-4
                         : block == "sensor"   ? 1e-8
                                               : 1e-3;
    out[block] = rms / std::max(least, it == floor.end() ? 0 : it->second);
  }
  return out;
}

}  // namespace ambrig
