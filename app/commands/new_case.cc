#include "app/commands/new_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "app/commands/screen.h"
#include "core/base/toml_edit.h"
#include "core/base/units.h"
#include "core/record/column_names.h"
#include "rig/clearance.h"
#include "rig/magnet_inverse.h"
#include "rig/rig_channels.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kStill = 0.05;  // of the gap: a place that stands
// Of the gap: noise of a distance that comes down to nothing, and how far it goes then.
constexpr double kTouches = 0.02, kGoesOn = 0.1;
constexpr double kOffCentre = 0.3;  // of the gap: far for a levitated rotor's mean
// Mean force over weight of a free body, and what laws of magnets miss at the ends of their gaps.
constexpr double kMostCarried = 3;
constexpr std::size_t kRowsLooked = 2000;

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

/// Whether a position column is x by its name: the channel's own, or one that begins with the letter alone.
bool SaysX(const ColumnChoice& c) {
  return c.reason == "same name" ||
         ((c.column[0] == 'x' || c.column[0] == 'X') &&
          (c.column.size() == 1 || !std::isalpha(static_cast<unsigned char>(c.column[1]))));
}

/// What becomes of the position column of a bearing: "" when it stays as it is, else what was done. `held` becomes
/// the place of a body that stands.
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

namespace {

/// The measured values of a channel in SI; null where it was not found in the record.
std::function<double(std::size_t row)> Measured(const Record& record,
                                                const std::vector<ColumnChoice>& all,
                                                const ChannelId& id) {
  for (const ColumnChoice& c : all) {
    if (c.channel != id.name()) continue;
    const Channel* column = FindColumn(record, c.column);
    const std::string_view si = RowOf(id.kind).unit;
    const double factor = c.gain * (c.unit.empty() ? 1 : UnitFactor(c.unit, std::string(si)));
    return [column, factor, offset = c.offset](std::size_t row) {
      return column->samples[row] * factor + offset;
    };
  }
  return nullptr;
}

/// Mean force of one bearing along its axes [N]; NaN where it cannot be told.
Eigen::Vector2d MeanForce(const BearingParameters& b, const Record& record,
                          const std::vector<ColumnChoice>& all) {
  std::vector<std::function<double(std::size_t)>> current, place;
  for (const ChannelId& id : ChannelsOf(b, ChannelKind::kCoilCurrent))
    current.push_back(Measured(record, all, id));
  for (const ChannelId& id : ChannelsOf(b, ChannelKind::kReading))
    place.push_back(Measured(record, all, id));
  const auto unknown = [](const auto& f) { return !f; };
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::nan(""));
  if (std::ranges::any_of(current, unknown) || std::ranges::any_of(place, unknown)) return none;
  const MagnetForce force = MagnetForceOf(b);
  const double most = 0.9 * GapOf(b);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0;
  Eigen::VectorXd i(static_cast<Eigen::Index>(current.size()));
  for (std::size_t row = 0; row < record.rows(); row += record.rows() / kRowsLooked + 1) {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < current.size(); ++k)
      i[static_cast<Eigen::Index>(k)] = current[k](row);
    for (std::size_t k = 0; k < place.size(); ++k) at[static_cast<Eigen::Index>(k)] = place[k](row);
    if (!i.allFinite() || !at.allFinite()) continue;
    if (at.norm() > most) at *= most / at.norm();
    const Eigen::VectorXd f = force(i, at);
    sum.head(f.size()) += f;
    count += 1;
  }
  return count > 0 ? Eigen::Vector2d(sum / count) : none;
}

}  // namespace

double CarriedShare(const RigParameters& rig, const Record& record,
                    const std::vector<ColumnChoice>& all) {
  const auto weight = WeightShares(rig);
  double along = 0, whole = 0;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    Eigen::Vector2d w(weight[k][0], weight[k][1]);
    if (w.norm() == 0) continue;
    along += w.dot(MeanForce(rig.bearings[k], record, all));
    whole += w.squaredNorm();
  }
  return whole > 0 ? along / whole : std::nan("");
}

std::vector<BenchRecord> RecordsOf(const RigParameters& rig, const Record& record,
                                   const std::vector<ColumnChoice>& all, const std::string& coils,
                                   const std::string& rotor, const std::string& data) {
  const bool moves = KnowsAll(all, rig, ChannelKind::kReading);
  std::vector<BenchRecord> out = {{coils, data, moves ? "motion" : "", all}};
  // Without a duty or a set-point the currents themselves drive the coils: nothing of them is predicted.
  if (moves && DriveOf(all, rig) == CommandSource::kCurrent) out.clear();
  if (!moves || !KnowsAll(all, rig, ChannelKind::kCoilCurrent)) return out;
  const double carried = CarriedShare(rig, record, all);
  if (!(carried > kMostCarried || carried < 1 / kMostCarried)) {
    out.push_back({rotor, data, "currents", all});
    return out;
  }
  fmt::print("{}\n",
             Wrapped(fmt::format("  the measured currents pull with {:.3g} times the weight: "
                                 "the body stands on something or is held, and the record "
                                 "says nothing of its motion under the magnets",
                                 carried),
                     4));
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
