#include "app/commands/new_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/screen.h"
#include "core/base/toml_edit.h"
#include "core/base/units.h"
#include "core/record/column_names.h"
#include "rig/clearance.h"
#include "rig/rig_channels.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kStill = 0.05;  // of the gap: a place that stands

bool Knows(const std::vector<ColumnChoice>& all, const std::string& channel) {
  return std::any_of(all.begin(), all.end(), [&](const auto& c) { return c.channel == channel; });
}

std::string Quoted(const std::string& s) {
  std::string out = "\"";
  for (const char c : s) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "\"";
}

}  // namespace

bool KnowsAll(const std::vector<ColumnChoice>& all, const RigParameters& rig, ChannelKind kind) {
  const auto ids = ChannelsOf(rig, kind);
  return std::all_of(ids.begin(), ids.end(), [&](const auto& id) { return Knows(all, id.name()); });
}

namespace {

/// Where a measured position lies most of the time [m]: spikes of the record do not count.
struct PlaceOfBody {
  double least = 0, middle = 0, most = 0;
};

PlaceOfBody PlaceOf(const Record& record, const ColumnChoice& c) {
  std::vector<double> v;
  for (const double s : FindColumn(record, c.column)->samples)
    if (std::isfinite(s)) v.push_back(s);
  if (v.empty()) return {};
  const double factor = c.gain * (c.unit.empty() ? 1 : UnitFactor(c.unit, "m"));
  for (double& s : v) s = s * factor + c.offset;
  std::sort(v.begin(), v.end());
  const auto at = [&](double share) {
    return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
  };
  return {at(0.02), at(0.5), at(0.98)};
}

/// What becomes of the position column of a bearing: "" when it stays as it is, else what was done. `held` becomes
/// the place of a body that stands.
std::string JudgePosition(const BearingParameters& b, const Record& record, ColumnChoice& c,
                          bool* leave_out, double* held) {
  const PlaceOfBody at = PlaceOf(record, c);
  const double gap = GapOf(b);
  const bool one_axis = b.Axes().size() == 1;
  // x counts from the middle and has both signs; a distance is never below zero.
  if (one_axis && c.reason != "said" && at.least > 0) {
    if (at.most - at.least < kStill * gap) {
      *held = gap - at.middle;
      *leave_out = true;
      return fmt::format(
          "{0}: {1} is taken as the distance from the magnet, the body as held at x = {2:.4g} m",
          c.channel, c.column, *held);
    }
    c.gain = -c.gain;
    c.offset = gap;
    return fmt::format(
        "{0}: {1} is taken as the distance from the magnet, x = {2:.4g} m - {1}; that it is x "
        "itself says --column {0}={1}",
        c.channel, c.column, gap);
  }
  if (std::max(std::abs(at.least), std::abs(at.most)) < 0.9 * gap) return "";
  *leave_out = true;
  return fmt::format(
      "{}: {} reaches {:.4g} m with a gap of {:.4g} m: left out, for x counts from the centred "
      "rotor",
      c.channel, c.column, std::max(std::abs(at.least), std::abs(at.most)), gap);
}

}  // namespace

double HoldAtDistance(const RigParameters& rig, const Record& record,
                      std::vector<ColumnChoice>& choices) {
  double held = 0;
  for (const BearingParameters& b : rig.bearings)
    for (const ChannelId& id : ChannelsOf(b, ChannelKind::kReading)) {
      const auto c = std::find_if(choices.begin(), choices.end(),
                                  [&](const ColumnChoice& o) { return o.channel == id.name(); });
      if (c == choices.end()) continue;
      bool leave_out = false;
      const std::string said = JudgePosition(b, record, *c, &leave_out, &held);
      if (!said.empty()) fmt::print("{}\n", Wrapped("  " + said, 4));
      if (leave_out) choices.erase(c);
    }
  return held;
}

CommandSource DriveOf(const std::vector<ColumnChoice>& all, const RigParameters& rig) {
  if (KnowsAll(all, rig, ChannelKind::kDuty)) return CommandSource::kDuty;
  if (KnowsAll(all, rig, ChannelKind::kSetPoint)) return CommandSource::kSetPoint;
  return KnowsAll(all, rig, ChannelKind::kCoilCurrent) ? CommandSource::kCurrent
                                                       : CommandSource::kNone;
}

std::string ScenarioOfRecord(const RigParameters& rig, const Record& r,
                             const std::vector<ColumnChoice>& all, const std::string& data,
                             double held) {
  std::string text = fmt::format(
      "# made by ambrig new: the record's own commands drive the coils\nname = \"the record\"\nrig "
      "= "
      "\"rig.toml\"\nduration = {}\nrecord_rate = {}\nfault_tolerance = false\n\n[start]\nstate = "
      "\"clamped\"\n",
      TomlNumber(r.start + static_cast<double>(r.rows()) / r.rate),
      TomlNumber(RecordRateFor(rig, r.rate)));
  if (held != 0)
    text += fmt::format("position = {{ {} = [{:.6g}, 0.0] }}\n", rig.bearings.front().name, held);
  const CommandSource drive = DriveOf(all, rig);
  if (drive != CommandSource::kDuty && drive != CommandSource::kCurrent) return text;
  const ChannelKind kind =
      drive == CommandSource::kDuty ? ChannelKind::kDuty : ChannelKind::kCoilCurrent;
  for (const ChannelId& id : ChannelsOf(rig, kind))
    for (const ColumnChoice& c : all)
      if (c.channel == id.name())
        text += fmt::format(
            "\n[[excitation]]\ntarget = \"{}.coil{}\"\nport = \"{}\"\nkind = \"samples\"\nfile = "
            "{}\nchannel = {}\nstart = 0.0\nstop = {}\n",
            id.plane, id.index + 1, drive == CommandSource::kDuty ? "duty" : "current",
            Quoted(data), Quoted(c.column),
            TomlNumber(r.start + static_cast<double>(r.rows()) / r.rate));
  return text;
}

std::string RotorScenario(const RigParameters& rig, const Record& r) {
  return fmt::format(
      "# made by ambrig new: the measured currents drive the rotor\nname = \"the rotor under "
      "measured "
      "currents\"\nrig = \"rig.toml\"\nduration = {}\nrecord_rate = {}\nfault_tolerance = false\n",
      TomlNumber(r.start + static_cast<double>(r.rows()) / r.rate),
      TomlNumber(RecordRateFor(rig, r.rate)));
}

std::vector<BenchRecord> RecordsOf(const RigParameters& rig, const std::vector<ColumnChoice>& all,
                                   const std::string& coils, const std::string& rotor,
                                   const std::string& data) {
  const bool moves = KnowsAll(all, rig, ChannelKind::kReading);
  std::vector<BenchRecord> out = {{coils, data, moves ? "motion" : "", all}};
  // Without a duty or a set-point the currents themselves drive the coils: nothing of them is predicted.
  if (moves && DriveOf(all, rig) == CommandSource::kCurrent) out.clear();
  if (moves && KnowsAll(all, rig, ChannelKind::kCoilCurrent))
    out.push_back({rotor, data, "currents", all});
  return out;
}

std::string CaseText(const std::vector<BenchRecord>& records) {
  std::string text = "# made by ambrig new\nrig = \"rig.toml\"\n";
  for (const BenchRecord& r : records) {
    text +=
        fmt::format("\n[[record]]\nscenario = {}\ndata = {}\n", Quoted(r.scenario), Quoted(r.data));
    if (r.imposed == "motion")
      text += "imposed = \"motion\"                     # measured positions move the gaps\n";
    if (r.imposed == "currents")
      text += "imposed = \"currents\"                   # measured currents drive the rotor\n";
    text += "[record.channels]\n";
    for (const ColumnChoice& c : r.columns) {
      text += fmt::format("\"{}\" = {{ column = {}", c.channel, Quoted(c.column));
      if (!c.unit.empty()) text += fmt::format(", unit = {}", Quoted(c.unit));
      if (c.gain != 1) text += fmt::format(", gain = {}", TomlNumber(c.gain));
      if (c.offset != 0) text += fmt::format(", offset = {}", TomlNumber(c.offset));
      text += " }\n";
    }
  }
  return text;
}

std::string LevitationText(const RigParameters& rig) {
  return fmt::format(
      "# made by ambrig new: no record yet - does it hover?\nname = \"levitation\"\nrig = "
      "\"rig.toml\"\nduration = 0.5\nrecord_rate = {}\nfault_tolerance = false\n\n[expect]\ndrop = "
      "false\nmax_orbit = {}                   # m, a quarter of the gap\n",
      TomlNumber(RecordRateFor(rig, rig.controller.rate)),
      TomlNumber(0.25 * GapOf(rig.bearings.front())));
}

}  // namespace ambrig
