#include "discovery/case/case_channels.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/record/column_names.h"
#include "core/record/units.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

/// One line for all files of which the same is to be said.
void NoteOnce(Case& c, const std::string& file, const std::string& text) {
  for (std::string& note : c.notes) {
    if (!note.ends_with(": " + text)) continue;
    note = fmt::format("{}, {}: {}", note.substr(0, note.size() - text.size() - 2), file, text);
    return;
  }
  c.notes.push_back(file + ": " + text);
}

/// The column as if it had come in time; rows without a sample are no numbers.
void MoveEarlier(std::vector<double>& y, double rows) {
  const std::vector<double> late = y;
  const auto by = std::lround(rows);
  const auto n = static_cast<long>(y.size());
  for (long k = 0; k < n; ++k)
    y[static_cast<std::size_t>(k)] = k + by >= 0 && k + by < n
                                         ? late[static_cast<std::size_t>(k + by)]
                                         : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::map<std::string, std::string> KnownChannels(const RigParameters& rig) {
  std::map<std::string, std::string> known;
  for (const ChannelRow& row : kChannels)
    for (const ChannelId& id : ChannelsOf(rig, row.kind)) known[id.name()] = row.unit;
  return known;
}

std::map<std::string, ChannelMapping> ReadMapping(const TomlTable& record,
                                                  const std::map<std::string, std::string>& known) {
  std::map<std::string, ChannelMapping> map;
  const auto channels = record.Table("channels");
  if (!channels) return map;
  std::string names;
  for (const auto& [name, unit] : known) names += (names.empty() ? "" : ",") + name;
  for (const std::string& channel : channels->Keys()) {
    if (!known.contains(channel)) {
      const std::string near = Nearest(channel, names);
      channels->Fail(channel, "is not a channel of this rig" +
                                  (near.empty() ? "" : ", did you mean " + near + "?"));
    }
    ChannelMapping m;
    if (channels->IsString(channel)) {
      m.column = channels->String(channel);
    } else {
      const TomlTable t = *channels->Table(channel);
      m.column = t.String("column", channel);
      m.unit = t.String("unit", "");
      m.gain = t.Number("gain", 1);
      m.offset = t.Number("offset", 0);
      m.late = t.Number("late", 0);
      m.use = t.Bool("use", true);
      if (!(std::abs(m.gain) > 0 && std::isfinite(m.gain)))
        t.Fail("gain", fmt::format("= {}, allowed: any but 0", m.gain));
      if (!std::isfinite(m.offset))
        t.Fail("offset", fmt::format("= {}, allowed: a number in {}", m.offset, known.at(channel)));
      t.RejectUnknownKeys();
    }
    map[channel] = m;
  }
  return map;
}

Record MapChannels(const Record& raw, const std::map<std::string, ChannelMapping>& mapping,
                   const std::map<std::string, std::string>& known, const TomlTable& table, Case& c,
                   std::map<std::string, ColumnSource>& sources) {
  Record out;
  out.rate = raw.rate;
  out.start = raw.start;
  out.gaps = raw.gaps;
  for (const auto& [channel, unit] : known) {
    const auto it = mapping.find(channel);
    if (it != mapping.end() && !it->second.use) continue;
    const std::string column = it == mapping.end() ? channel : it->second.column;
    const Channel* found = it == mapping.end() ? raw.Find(column) : FindColumn(raw, column);
    if (!found) {
      if (it != mapping.end())
        throw InputError(fmt::format("{}: column \"{}\" of {} is not in {}, allowed: {}",
                                     table.Where("channels"), column, channel, table.String("data"),
                                     ColumnsOf(raw, column)));
      continue;
    }
    Channel converted = *found;
    converted.name = channel;
    const std::string from =
        it != mapping.end() && !it->second.unit.empty() ? it->second.unit : found->unit;
    const double factor =
        (from.empty() ? 1 : UnitFactor(from, unit, table.Where("data") + ": channel " + channel)) *
        (it == mapping.end() ? 1 : it->second.gain);
    const double offset = it == mapping.end() ? 0 : it->second.offset;
    for (double& v : converted.samples) v = v * factor + offset;
    const double length = static_cast<double>(raw.rows()) / raw.rate;
    if (it != mapping.end() && it->second.late != 0 && !(std::abs(it->second.late) < length))
      table.Fail("channels",
                 fmt::format("\"{}\": late = {:g} s, allowed: less than the {:g} s of {}", channel,
                             it->second.late, length, table.String("data")));
    if (it != mapping.end() && it->second.late != 0)
      MoveEarlier(converted.samples, it->second.late * raw.rate);
    sources[channel] = {column, unit, factor};
    converted.unit = unit;
    out.channels.push_back(std::move(converted));
  }
  std::string ignored;
  for (const Channel& ch : raw.channels) {
    bool used = known.contains(ch.name) && !mapping.contains(ch.name);
    for (const auto& [channel, m] : mapping) used = used || FindColumn(raw, m.column) == &ch;
    if (!used && ch.name != "t") ignored += (ignored.empty() ? "" : ", ") + ch.name;
  }
  if (!ignored.empty())
    NoteOnce(c, table.String("data"), "columns without a rig channel, left out: " + ignored);
  return out;
}

}  // namespace ambrig
