#include "discovery/model/filtered_noise.h"

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/held_values.h"
#include "discovery/model/case_model.h"
#include "discovery/model/row_stretches.h"

namespace ambrig {

namespace {

constexpr double kFilteredFrom = 1.35;  // of the white noise
constexpr std::size_t kLeastStretches = 8;

bool HasOwnNoise(const CaseRecord& record, const std::string& channel) {
  return IsOfKind(channel, ChannelKind::kBus) || IsOfKind(channel, ChannelKind::kLoadCell) ||
         (IsOfKind(channel, ChannelKind::kReading) &&
          record.scenario.start == StartState::kClamped);
}

std::vector<ErrorStretch> ErrorStretches(const CaseModel& model,
                                         const std::vector<const Target*>& of,
                                         const std::vector<double>& predicted) {
  std::vector<ErrorStretch> out;
  for (const RowStretch& s : StretchesOf(model, of, kLeastStretches)) {
    out.emplace_back();
    for (std::size_t k = s.first; k < s.first + s.length; ++k) {
      out.back().error.push_back(model.measured()[k] - predicted[k]);
      out.back().predicted.push_back(predicted[k]);
    }
  }
  return out;
}

}  // namespace

std::map<std::string, FilteredNoise> FilteredNoises(const CaseModel& model,
                                                    const std::vector<double>& predicted,
                                                    const std::map<std::string, double>& white) {
  std::map<std::string, std::vector<const Target*>> targets;
  for (const Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    const Channel& channel = record.data.channels[t.channel];
    if (OverTime(record) && HasOwnNoise(record, channel.name) && RegularHold(channel.samples) == 1)
      targets[channel.name].push_back(&t);
  }
  std::map<std::string, FilteredNoise> out;
  for (const auto& [channel, of] : targets) {
    const auto own = white.find(channel);
    if (own == white.end() || !(own->second > 0)) continue;
    const FilteredNoise found = NoiseOfStretches(ErrorStretches(model, of, predicted), own->second);
    if (found.rms > kFilteredFrom * own->second) out[channel] = found;
  }
  return out;
}

}  // namespace ambrig
