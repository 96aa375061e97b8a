#include "app/commands/new_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "app/text/screen.h"
#include "core/base/errors.h"
#include "core/base/toml_edit.h"
#include "core/record/column_names.h"
#include "core/record/units.h"
#include "rig/clearance.h"
#include "rig/rig_channels.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kStill = 0.05;  // of the gap: a place that stands
// Of the gap: noise of a distance that comes down to nothing, and how far it goes then.
constexpr double kTouches = 0.02, kGoesOn = 0.1;
constexpr double kOffCentre = 0.3;  // of the gap: far for a levitated rotor's mean

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

/// Whether a position column is x by its name: the channel's own, or one that begins with the
/// letter alone.
bool SaysX(const ColumnChoice& c) {
  return c.reason == "same name" ||
         ((c.column[0] == 'x' || c.column[0] == 'X') &&
          (c.column.size() == 1 || !std::isalpha(static_cast<unsigned char>(c.column[1]))));
}

/// What becomes of the position column of a bearing: "" when it stays as it is, else what was done.
/// `held` becomes the place of a body that stands.
std::string JudgePosition(const BearingParameters& b, const Record& record, ColumnChoice& c,
                          bool* leave_out, double* held) {
  const PlaceOfBody at = PlaceOf(record, c);
  const double gap = GapOf(b);
  const bool one_axis = b.Axes().size() == 1;
  // x counts from the middle and has both signs; a distance is never below zero.
  const bool distance = at.least > 0 || (at.least > -kTouches * gap && at.most > kGoesOn * gap);
  if (one_axis && c.reason != "said" && distance && !SaysX(c)) {
    if (at.most - at.least < kStill * gap) {
      *held = gap - at.middle;
      *leave_out = true;
      return fmt::format(
          "{0}: {1} is taken as the distance from the magnet, the body as held at x = {2:.4g} m; "
          "that it is x itself says --column {0}={1}",
          c.channel, c.column, *held);
    }
    c.gain = -c.gain;
    c.offset = gap;
    return fmt::format(
        "{0}: {1} is taken as the distance from the magnet, x = {2:.4g} m - {1}; that it is x "
        "itself says --column {0}={1}",
        c.channel, c.column, gap);
  }
  if (std::max(std::abs(at.least), std::abs(at.most)) < 0.9 * gap) {
    if (c.reason == "said" || std::abs(at.middle) < kOffCentre * gap) return "";
    return fmt::format(
        "{0}: {1} is taken as x, which counts from the centred rotor, and lies at {2:.4g} m with a "
        "gap of {3:.4g} m; if it is the distance from the magnet, --column {0}={1}:{4}:-1:{3:.4g}",
        c.channel, c.column, at.middle, gap, c.unit.empty() ? "m" : c.unit);
  }
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

void PrintChoices(const Record& r, const std::vector<ColumnChoice>& all, const RigParameters& rig) {
  fmt::print("record: {} rows at {:.6g} Hz\n", r.rows(), r.rate);
  fmt::print("  {:<7} {:<20} {:<5} {:>5} {:>10} {:>10}  {}\n", "channel", "column", "unit", "gain",
             "least", "most", "because");
  for (const ColumnChoice& c : all)
    for (const Channel& column : r.channels) {
      if (column.name != c.column) continue;
      double lo = kInfinity, hi = -kInfinity;
      for (const double v : column.samples) {
        if (!std::isfinite(v)) continue;
        lo = std::min(lo, v);
        hi = std::max(hi, v);
      }
      fmt::print("  {:<7} {:<20} {:<5} {:>5g} {:>10.4g} {:>10.4g}  {}\n", c.channel, c.column,
                 c.unit.empty() ? "SI" : c.unit, c.gain, lo, hi, c.reason);
    }
  for (const std::string& note : r.notes) fmt::print("{}\n", Wrapped("  " + note, 4));
  std::string left;
  for (const Channel& column : r.channels)
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& c) { return c.column == column.name; }))
      left += (left.empty() ? "" : ", ") + column.name;
  if (!left.empty()) fmt::print("{}\n", Wrapped("  not taken: " + left, 4));
  const char* driven[] = {"measured duties", "measured set-points", "measured currents", ""};
  const CommandSource drive = DriveOf(all, rig);
  if (drive == CommandSource::kNone)
    throw InputError(
        "no duties, set-points or currents of all coils were found in the record, "
        "allowed: --column CHANNEL=COLUMN for each");
  fmt::print("  coils driven by: {}; gaps moved by: {}\n", driven[static_cast<int>(drive)],
             KnowsAll(all, rig, ChannelKind::kReading) ? "measured positions" : "nothing (held)");
  fmt::print("  another column, unit or sign: --column CHANNEL=COLUMN:UNIT:GAIN:OFFSET\n");
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

std::vector<BenchRecord> RecordsOf(const RigParameters& rig, const Record& record,
                                   const std::vector<ColumnChoice>& all, const std::string& coils,
                                   const std::string& rotor, const std::string& data,
                                   BodySaid said) {
  const bool moves = KnowsAll(all, rig, ChannelKind::kReading);
  std::vector<BenchRecord> out = {{coils, data, moves ? "motion" : "", all}};
  // Without a duty or a set-point the currents themselves drive the coils: nothing of them is
  // predicted.
  if (moves && DriveOf(all, rig) == CommandSource::kCurrent) out.clear();
  if (!moves || !KnowsAll(all, rig, ChannelKind::kCoilCurrent)) return out;
  if (!IsFree(rig, record, all, said)) return out;
  if (!out.empty() && LacksCommands(rig, record, all)) out.clear();
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
