// Columns that say nothing in a whole record: empty, or at one value where the rig moves.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/record/channels.h"
#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

namespace {

/// The whole column is at fault: its other rows would be lost with a span of time that is left out.
void TellUseless(const CaseRecord& r, const std::string& channel, const std::string& fault,
                 const char* with, std::vector<DataFault>& out) {
  DataFault f;
  f.record = r.data_file;
  f.channel = channel;
  f.fault = fault;
  f.with = with;
  f.seconds = static_cast<double>(r.data.rows()) / r.data.rate;
  f.mend = fmt::format("channels.\"{}\" = {{ use = false }}", channel);
  f.probability = 0.99;
  out.push_back(f);
}

/// Without a voltage the bridges carry no current: the column was not connected, whatever the rig
/// does.
bool IsDeadBus(const CaseModel& model, const CaseRecord& r, std::size_t channel) {
  const Channel& c = r.data.channels[channel];
  return IsOfKind(c.name, ChannelKind::kBus) && model.data().rig.amplifier.bus_voltage > 0 &&
         r.data.rows() > 1 && std::ranges::all_of(c.samples, [](double v) { return v == 0; });
}

/// Whether the column shows noise: it takes some values at least.
bool ShowsNoise(const std::vector<double>& y) {
  constexpr std::size_t kValues = 8;
  std::set<double> seen;
  for (const double v : y) {
    if (std::isfinite(v)) seen.insert(v);
    if (seen.size() >= kValues) return true;
  }
  return false;
}

/// The reading of a held shaft is its place and the noise of its sensor. At one value beside
/// readings that show noise, and elsewhere than expected, its converter stood at its limit or its
/// logger still.
bool IsStuckReading(const CaseRecord& r, std::size_t channel, const GateColumn& c) {
  constexpr double kElsewhere = 3;  // floors
  const Channel& reading = r.data.channels[channel];
  if (r.scenario.start != StartState::kClamped || !IsOfKind(reading.name, ChannelKind::kReading) ||
      c.match.error < kElsewhere ||
      !std::ranges::all_of(reading.samples, [&](double v) { return v == reading.samples.front(); }))
    return false;
  return std::ranges::any_of(r.data.channels, [](const Channel& other) {
    return IsOfKind(other.name, ChannelKind::kReading) && ShowsNoise(other.samples);
  });
}

}  // namespace

void CheckConstantColumns(const CaseModel& model, std::size_t record,
                          std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (std::size_t k = 0; k < r.quality.size(); ++k) {
    const ChannelQuality& q = r.quality[k];
    const std::vector<double>& y = r.data.channels[k].samples;
    const auto c = std::ranges::find(columns, q.channel, &GateColumn::name);
    if (!q.use && q.verdict.starts_with("empty"))
      TellUseless(r, q.channel, "lost", kEmpty, out);
    else if (q.use && IsDeadBus(model, r, k))
      TellUseless(r, q.channel, "lost", kWholeColumn, out);
    else if (q.use ? c != columns.end() && IsStuckReading(r, k, *c)
                   : q.verdict.starts_with("stuck") && r.scenario.start != StartState::kClamped)
      TellUseless(r, q.channel, y.front() == 0 ? "lost" : "freeze", kWholeColumn, out);
    else
      continue;
    if (c != columns.end()) c->explained = true;
  }
}

}  // namespace ambrig
