#include "app/json/difference_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/text/format.h"
#include "app/text/screen.h"
#include "core/base/counted.h"
#include "core/base/json_file.h"
#include "core/record/read_record.h"
#include "core/record/units.h"

namespace ambrig {

namespace {

/// A value with its unit and the prefix that a reader expects.
std::string WithUnit(double value, const std::string& unit) {
  return TerminalText(FormatSi(value, unit, 4));
}

std::string LineOf(const ChannelDifference& c) {
  if (c.rows == 0) return fmt::format("{}: {}", c.channel, VerdictText(c.verdict));
  const std::string worst = c.worst > 0 ? fmt::format(", worst {} at {:.6g} ms",
                                                      WithUnit(c.worst, c.unit), c.worst_at * 1e3)
                                        : "";  // of what is no number
  return fmt::format(
      "{}: {} from {:.6g} ms, {} of {} rows{}{}", c.channel, VerdictText(c.verdict), c.first * 1e3,
      c.beyond, c.rows, worst,
      c.allowed > 0 ? fmt::format(" (allowed {})", WithUnit(c.allowed, c.unit)) : "");
}

}  // namespace

RunFiles ReadRun(const std::string& record_file) {
  RunFiles out{record_file, ReadRecord(record_file), nullptr};
  ConvertToSi(out.record);
  const std::string beside = std::filesystem::path(record_file).replace_extension(".json").string();
  if (!std::filesystem::is_regular_file(beside)) return out;
  const nlohmann::json json = ReadJson(beside);
  if (json.is_object() && json.contains("events") && json["events"].is_array())
    out.events = json["events"];
  CheckEvents(out.events, beside);
  return out;
}

RunDifference CompareRuns(const RunFiles& a, const RunFiles& b, const RecordTolerances& t) {
  RunDifference d;
  d.a = a.file;
  d.b = b.file;
  d.record = CompareRecords(a.record, b.record, t);
  d.events_known = a.events.is_array() && b.events.is_array();
  if (d.events_known) d.events = CompareEvents(a.events, b.events, t.events);
  return d;
}

std::vector<std::string> DifferenceLines(const RunDifference& d, std::size_t most) {
  std::vector<std::string> lines;
  if (const ChannelDifference* first = d.record.First())
    lines.push_back(fmt::format("first: {} at {:.6g} ms", first->channel, first->first * 1e3));
  if (!d.record.length.empty()) lines.push_back("record " + d.record.length);
  for (std::size_t k = 0; k < std::min(most, d.events.size()); ++k)
    lines.push_back("event " + EventDifferenceText(d.events[k]));
  if (d.events.size() > most)
    lines.push_back("and " + Counted(d.events.size() - most, "more event"));
  std::vector<const ChannelDifference*> bad;
  for (const ChannelDifference& c : d.record.channels)
    if (c.bad()) bad.push_back(&c);
  // What is missing or no number is told before what only differs.
  std::ranges::stable_sort(bad, {}, [](const ChannelDifference* c) {
    return std::pair(c->verdict == ChannelVerdict::kDiffers, c->first);
  });
  for (std::size_t k = 0; k < std::min(most, bad.size()); ++k) lines.push_back(LineOf(*bad[k]));
  if (bad.size() > most) lines.push_back("and " + Counted(bad.size() - most, "more channel"));
  return lines;
}

nlohmann::ordered_json DifferenceJson(const RunDifference& d) {
  nlohmann::ordered_json channels = nlohmann::ordered_json::array(), events = channels;
  for (const ChannelDifference& c : d.record.channels)
    channels.push_back({{"channel", c.channel},
                        {"verdict", VerdictText(c.verdict)},
                        {"unit", c.unit},
                        {"first", c.first},
                        {"worst", c.worst},
                        {"worst_at", c.worst_at},
                        {"rms", c.rms},
                        {"allowed", c.allowed},
                        {"rows", c.rows},
                        {"beyond", c.beyond}});
  for (const EventDifference& e : d.events) {
    const auto kind = e.kind == EventDifference::Kind::kCame   ? "came"
                      : e.kind == EventDifference::Kind::kWent ? "went"
                                                               : "moved";
    events.push_back({{"event", e.event}, {"kind", kind}});
    if (e.kind != EventDifference::Kind::kCame) events.back()["before"] = e.before;
    if (e.kind != EventDifference::Kind::kWent) events.back()["after"] = e.after;
  }
  nlohmann::ordered_json first = nullptr;
  if (const ChannelDifference* c = d.record.First())
    first = {{"channel", c->channel}, {"t", c->first}};
  return {{"a", d.a},
          {"b", d.b},
          {"identical", d.identical()},
          {"agrees", d.agrees()},
          {"first", first},
          {"length", d.record.length},
          {"events_compared", d.events_known},
          {"events", events},
          {"channels", channels}};
}

}  // namespace ambrig
