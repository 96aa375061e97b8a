#include "discovery/experiment/measured_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "core/record/channels.h"

namespace ambrig {

namespace {

// of the worst channel: to be seen, and not grotesque
constexpr double kLeastRatio = 5, kMostRatio = 60;
constexpr std::uint32_t kLoadCells = 104;  // stream of random numbers

}  // namespace

double UsualLoadCellNoise(const RigParameters& rig) { return 0.0012 * rig.rotor.mass * 9.81; }

ShownChange WorstChannel(const CaseModel& model, const std::vector<double>& with,
                         const std::vector<double>& without) {
  ShownChange worst;
  for (const Target& t : model.targets()) {
    double sum = 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      sum += std::pow(with[k] - without[k], 2);
    const double ratio =
        std::sqrt(sum / static_cast<double>(std::max<std::size_t>(t.count, 1))) / t.floor;
    const CaseRecord& r = model.data().records[t.record];
    if (ratio > worst.ratio) worst = {ratio, r.data.channels[t.channel].name};
  }
  return worst;
}

std::optional<ShownEffects> VisibleEffects(
    const CaseModel& model, const Hypothesis& truth, const std::vector<double>& without,
    const std::function<std::vector<EffectInstance>(double)>& of_size) {
  double k = 1;
  for (int attempt = 0; attempt < 12; ++attempt) {
    Hypothesis h = truth;
    std::vector<EffectInstance> effects = of_size(k);
    h.rig.effects.insert(h.rig.effects.end(), effects.begin(), effects.end());
    const auto with = model.Predict(h);
    const ShownChange shown =
        with ? WorstChannel(model, *with, without) : ShownChange{kInfinity, ""};
    if (shown.ratio >= kLeastRatio && shown.ratio <= kMostRatio)
      return ShownEffects{std::move(effects), shown};
    k *= !with ? 0.5 : shown.ratio < kLeastRatio ? 2.0 : 0.7;
  }
  return {};
}

void MeasureRecord(const CaseModel& model, const Hypothesis& truth, std::size_t record,
                   std::uint64_t seed, double load_cell_noise, Case& data) {
  const Record simulated = model.Simulated(truth, record, true, seed * 1000003 + record);
  std::uint64_t cell = 0;
  for (Channel& ch : data.records[record].data.channels) {
    const Channel* from = simulated.Find(ch.name);
    if (!from)
      throw InputError(fmt::format("\"{}\": the simulation gives no channel {}",
                                   data.records[record].scenario.name, ch.name));
    ch.samples.assign(from->samples.begin(),
                      from->samples.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                  from->samples.size(), ch.samples.size())));
    if (!IsOfKind(ch.name, ChannelKind::kLoadCell)) continue;
    for (std::size_t k = 0; k < ch.samples.size(); ++k)
      ch.samples[k] +=
          load_cell_noise *
          Normal(seed, kLoadCells + static_cast<std::uint32_t>(record), (cell << 32) + k);
    ++cell;
  }
}

}  // namespace ambrig
