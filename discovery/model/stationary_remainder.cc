#include "discovery/model/stationary_remainder.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/record/channels.h"
#include "discovery/data/held_values.h"
#include "discovery/data/stationary_noise.h"
#include "discovery/model/case_model.h"
#include "discovery/model/residual.h"
#include "discovery/model/row_stretches.h"

namespace ambrig {

namespace {

constexpr double kNothingAbove = 1.1;   // error over the floor, nothing to be explained
constexpr double kRecordsAlike = 1.25;  // error of a record over that of all

using Targets = std::vector<const Target*>;

const Channel& ChannelOfTarget(const CaseModel& model, const Target& t) {
  return model.data().records[t.record].data.channels[t.channel];
}

bool IsLevitated(const CaseRecord& record) {
  return OverTime(record) && record.scenario.start != StartState::kClamped;
}

/// The target of `channel` in the record of `t` whose rows are those of `t`; null: none.
const Target* Beside(const CaseModel& model, const Target& t, const std::string& channel) {
  for (const Target& other : model.targets())
    if (other.record == t.record && other.count == t.count &&
        ChannelOfTarget(model, other).name == channel)
      return &other;
  return nullptr;
}

/// Channels that all records of these targets have, the own one first.
std::vector<std::string> CommonChannels(const CaseModel& model, const Targets& of) {
  std::vector<std::string> names = {ChannelOfTarget(model, *of[0]).name};
  for (const Target& other : model.targets()) {
    const std::string& name = ChannelOfTarget(model, other).name;
    if (other.record == of[0]->record && name != names[0] &&
        std::all_of(of.begin(), of.end(), [&](const Target* t) { return Beside(model, *t, name); }))
      names.push_back(name);
  }
  return names;
}

std::vector<DrivenStretch> DrivenStretches(const CaseModel& model, const Targets& of,
                                           const std::vector<double>& predicted,
                                           const std::vector<double>& residual) {
  const std::vector<std::string> channels = CommonChannels(model, of);
  std::vector<DrivenStretch> out;
  for (const RowStretch& s : StretchesOf(model, of, kFewestOfNoise)) {
    DrivenStretch one;
    for (std::size_t k = s.first; k < s.first + s.length; ++k)
      one.error.push_back(residual[k] * s.target->floor);
    for (const std::string& channel : channels) {
      const auto from =
          predicted.begin() + static_cast<std::ptrdiff_t>(Beside(model, *s.target, channel)->first +
                                                          (s.first - s.target->first));
      one.predicted.emplace_back(from, from + static_cast<std::ptrdiff_t>(s.length));
    }
    out.push_back(std::move(one));
  }
  return out;
}

/// Root mean square of the floors.
double FloorOfAll(const Targets& of) {
  double sum = 0, rows = 0;
  for (const Target* t : of) {
    sum += t->floor * t->floor * static_cast<double>(t->count);
    rows += static_cast<double>(t->count);
  }
  return std::sqrt(sum / rows);
}

}  // namespace

StationaryRemainder StationaryRemainderOf(const CaseModel& model,
                                          const std::vector<double>& predicted,
                                          const std::vector<double>& residual) {
  StationaryRemainder out;
  std::map<std::string, Targets> levitated;
  for (const Target& t : model.targets()) {
    out.floors.push_back(t.floor);
    if (IsLevitated(model.data().records[t.record]))
      levitated[ChannelOfTarget(model, t).name].push_back(&t);
    else if (TargetRatio(model, residual, t) > kNothingAbove)
      return {};
  }
  for (const auto& [name, of] : levitated) {
    const auto ratio = [&](const Target* t) { return TargetRatio(model, residual, *t); };
    if (std::all_of(of.begin(), of.end(),
                    [&](const Target* t) { return ratio(t) <= kNothingAbove; }))
      continue;
    const bool held = std::any_of(of.begin(), of.end(), [&](const Target* t) {
      return RegularHold(ChannelOfTarget(model, *t).samples) != 1;
    });
    if (held) return {};
    const double expected = FloorOfAll(of);
    const auto noise = StationaryNoiseOf(DrivenStretches(model, of, predicted, residual), expected);
    if (!noise) return {};
    for (const Target* t : of) {
      const double error = ratio(t) * t->floor;
      if (error > kRecordsAlike * noise->rms) return {};
      double& floor = out.floors[static_cast<std::size_t>(t - model.targets().data())];
      floor = std::max(floor, error);
    }
    const double rate = model.data().records[of[0]->record].data.rate;
    out.channels.push_back({name, noise->rms, expected, noise->middle * rate});
  }
  return out;
}

std::vector<std::string> RemainderRemarks(const StationaryRemainder& noise) {
  // Of every kind of channel the one that shows it most.
  std::map<ChannelKind, std::pair<const UnexpectedNoise*, int>> kinds;
  const auto larger = [](const UnexpectedNoise& n) { return n.rms / n.expected; };
  for (const UnexpectedNoise& n : noise.channels) {
    auto& [most, count] = kinds[ParseChannel(n.channel)->kind];
    if (!most || larger(n) > larger(*most)) most = &n;
    ++count;
  }
  std::vector<std::string> lines;
  for (const auto& [kind, of] : kinds) {
    const auto& [n, count] = of;
    lines.push_back(fmt::format(
        "noise of {}{} while the rotor is levitated: {:.3g} where the known noise makes {:.3g}, "
        "most of it about {:.3g} Hz, the same in all records and coherent with no motion: it "
        "counts as noise",
        n->channel, count > 1 ? fmt::format(" and {} like it", count - 1) : "", n->rms, n->expected,
        n->frequency));
  }
  return lines;
}

}  // namespace ambrig
