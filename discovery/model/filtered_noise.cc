#include "discovery/model/filtered_noise.h"

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/held_values.h"
#include "discovery/model/case_model.h"

namespace ambrig {

namespace {

constexpr double kFilteredFrom = 1.35;      // of the white noise
constexpr std::size_t kLeastStretches = 8;  // at least
constexpr std::size_t kStretchLengths[] = {
    1024, 512, 256};  // rows of a stretch, the longest of which there are enough

bool HasOwnNoise(const CaseRecord& record, const std::string& channel) {
  return IsOfKind(channel, ChannelKind::kBus) || IsOfKind(channel, ChannelKind::kLoadCell) ||
         (IsOfKind(channel, ChannelKind::kReading) &&
          record.scenario.start == StartState::kClamped);
}

/// Stretches of `length` rows all of which count, one behind the other.
void AddStretches(const CaseModel& model, const Target& t, const std::vector<double>& predicted,
                  std::size_t length, std::vector<ErrorStretch>& out) {
  for (std::size_t first = t.first; first + length <= t.first + t.count;) {
    std::size_t bad = length;
    while (bad > 0 && model.ok()[first + bad - 1]) --bad;
    if (bad > 0) {
      first += bad;
      continue;
    }
    out.emplace_back();
    for (std::size_t k = first; k < first + length; ++k) {
      out.back().error.push_back(model.measured()[k] - predicted[k]);
      out.back().predicted.push_back(predicted[k]);
    }
    first += length;
  }
}

std::vector<ErrorStretch> StretchesOf(const CaseModel& model, const std::vector<const Target*>& of,
                                      const std::vector<double>& predicted) {
  for (const std::size_t length : kStretchLengths) {
    std::vector<ErrorStretch> out;
    for (const Target* t : of) AddStretches(model, *t, predicted, length, out);
    if (out.size() >= kLeastStretches) return out;
  }
  return {};
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
    const FilteredNoise found = NoiseOfStretches(StretchesOf(model, of, predicted), own->second);
    if (found.rms > kFilteredFrom * own->second) out[channel] = found;
  }
  return out;
}

}  // namespace ambrig
