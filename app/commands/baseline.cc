#include "app/commands/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "app/text/screen.h"
#include "core/base/errors.h"
#include "core/base/json_file.h"
#include "core/record/channels.h"
#include "core/record/hdf5.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;

/// Readings, currents, speed and bus: what a rig's own logger would keep.
bool KeptByDefault(const std::string& name) {
  const auto id = ParseChannel(name);
  if (!id) return false;
  return id->kind == ChannelKind::kReading || id->kind == ChannelKind::kCoilCurrent ||
         id->kind == ChannelKind::kSpeed || id->kind == ChannelKind::kBus;
}

bool FitsOneOf(const std::vector<std::string>& patterns, const std::string& name) {
  RecordTolerances all;
  for (const std::string& p : patterns) all.patterns.emplace_back(p, ChannelTolerance{1});
  return all.Of(name).absolute > 0;
}

bool Kept(const BaselineOptions& o, const std::string& name) {
  return o.channels.empty() ? KeptByDefault(name) : FitsOneOf(o.channels, name);
}

/// Channels of all baselines of the folder; one that cannot be read is told where it is compared.
std::set<std::string> StoredChannels(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().string().ends_with(".baseline.h5")) continue;
    try {
      for (const Channel& c : ReadHdf5(entry->path().string()).channels) names.insert(c.name);
    } catch (const InputError&) {
      continue;
    }
  }
  return names;
}

}  // namespace

std::string BaselineFile(const BaselineOptions& o, const std::string& scenario_file) {
  std::string name = fs::path(scenario_file).lexically_normal().replace_extension().string();
  if (fs::path(name).is_absolute()) name = fs::path(name).filename().string();
  for (std::size_t at = name.find('/'); at != std::string::npos; at = name.find('/'))
    name.replace(at, 1, "__");
  return (fs::path(o.folder) / (name + ".baseline.h5")).string();
}

Record BaselineRecord(const BaselineOptions& o, const RunFiles& run,
                      const std::map<std::string, std::string>& provenance) {
  Record out;
  const std::size_t step = std::max<std::size_t>(1, (run.record.rows() + o.rows - 1) / o.rows);
  out.rate = run.record.rate / static_cast<double>(step);
  out.start = run.record.start;
  for (const Channel& c : run.record.channels) {
    if (!Kept(o, c.name)) continue;
    out.channels.push_back({c.name, c.unit, {}});
    for (std::size_t k = 0; k < c.samples.size(); k += step)
      out.channels.back().samples.push_back(static_cast<double>(static_cast<float>(c.samples[k])));
  }
  if (out.channels.empty())
    throw InputError("--channels: no channel of the record fits, allowed: e.g. 'A.x' or 'A.i*'");
  out.attributes = provenance;
  out.attributes["made_by"] = "ambrig check --accept";
  out.attributes["events"] = JsonText(run.events);
  out.attributes["rows_kept"] = fmt::format("every {} of {}", step, run.record.rows());
  return out;
}

RunFiles ReadBaseline(const std::string& file) {
  if (!fs::is_regular_file(file))
    throw InputError(file + ": no such baseline; --accept stores this run as the baseline");
  RunFiles out{file, ReadHdf5(file), nullptr};
  const auto events = out.record.attributes.find("events");
  if (events != out.record.attributes.end())
    out.events = nlohmann::json::parse(events->second, nullptr, false);
  if (!out.events.is_array())
    throw InputError(file + ": holds no events, allowed: a file that check --accept made");
  CheckEvents(out.events, file);
  return out;
}

RecordTolerances BaselineTolerances(const BaselineOptions& o) {
  const std::string file = (fs::path(o.folder) / "tolerances.toml").string();
  if (fs::is_regular_file(file)) return ReadTolerances(file);
  RecordTolerances t;
  t.all.relative = 1e-6;
  return t;
}

void RequireTolerancesFit(const BaselineOptions& o) {
  const RecordTolerances tolerances = BaselineTolerances(o);
  if (tolerances.patterns.empty()) return;
  const std::set<std::string> stored = StoredChannels(o.folder);
  if (stored.empty()) return;
  std::string all;
  for (const std::string& name : stored) all += (all.empty() ? "" : ", ") + name;
  for (const auto& [pattern, tolerance] : tolerances.patterns)
    if (std::ranges::none_of(stored,
                             [&](const std::string& name) { return FitsOneOf({pattern}, name); }))
      throw InputError(fmt::format(
          "{}: channel.\"{}\" fits no channel of the baselines, allowed: {}",
          (fs::path(o.folder) / "tolerances.toml").string(), pattern, Shortened(all, 300)));
}

RunDifference CompareToBaseline(const RunFiles& baseline, const RunFiles& now,
                                const RecordTolerances& t) {
  RunFiles chosen{now.file, {}, now.events};
  chosen.record.rate = now.record.rate;
  chosen.record.start = now.record.start;
  for (const Channel& c : baseline.record.channels)
    if (const Channel* found = now.record.Find(c.name)) chosen.record.channels.push_back(*found);
  if (chosen.record.channels.empty())
    throw InputError(baseline.file + ": has no channel in common with the new record");
  RunDifference d = CompareRuns(baseline, chosen, t);
  // The last row of a decimated record stands up to a step before the end.
  const double end_a = baseline.record.TimeAt(baseline.record.rows()),
               end_b = now.record.TimeAt(now.record.rows());
  if (std::abs(end_a - end_b) <= 1 / baseline.record.rate) d.record.length.clear();
  return d;
}

}  // namespace ambrig
