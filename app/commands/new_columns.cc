#include "app/commands/new_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/base/errors.h"
#include "core/record/column_names.h"
#include "core/record/units.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

constexpr int kSameName = 100, kLeastScore = 3;

/// "pos_ax [um]" -> {"pos", "ax"}, lower case; digits stay with the letters before them.
std::vector<std::string> Words(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (c == '[' || c == '(') break;
    if (std::isalnum(static_cast<unsigned char>(c)))
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Unit of a column: its own, else the last word of its name ("i1_A").
std::string UnitOf(const Channel& c) {
  if (!c.unit.empty()) return c.unit;
  const std::size_t bar = c.name.rfind('_');
  if (bar == std::string::npos) return "";
  const std::string word = c.name.substr(bar + 1);
  return KnownUnit(word) ? word : "";
}

/// What a person may call a channel of one bearing: words of its quantity, then its number or
/// direction.
struct Called {
  std::vector<std::string> quantity;
  std::string which;  // "x", "1"
  std::string unit;   // SI
};

Called NamesOf(const ChannelId& id, const std::string& unit) {
  const std::string number = std::to_string(id.index + 1);
  switch (id.kind) {
    case ChannelKind::kReading:
      return {{"x", "pos", "position", "disp", "displacement", "sensor", "y", "z", "gap", "stroke",
               "distance"},
              std::string(1, "xyz"[id.index]),
              unit};
    case ChannelKind::kCoilCurrent:
      return {{"i", "current", "cur", "coil"}, number, unit};
    case ChannelKind::kSetPoint:
      return {{"s", "iset", "iref", "setpoint", "ref"}, number, unit};
    case ChannelKind::kDuty:
      return {{"d", "duty", "pwm", "u"}, number, unit};
    case ChannelKind::kLoadCell:
      return {{"f", "force", "load"}, std::string(1, "xyz"[id.index]), unit};
    default:
      return {{"bus", "ubus", "vbus", "supply", "udc"}, "", unit};
  }
}

/// How well a column fits; 0: not at all. `alone`: the rig has one such channel of one bearing.
int Score(const Channel& column, const ChannelId& id, const Called& called, bool alone) {
  if (FindColumn({1, 0, {column}}, id.name())) return kSameName;
  const std::string unit = UnitOf(column);
  if (!unit.empty() && SiUnit(unit) != called.unit && called.unit != "-") return 0;
  const bool duty_words = id.kind == ChannelKind::kDuty;
  int score = 0;
  bool quantity = false, which = false, place = alone;
  std::string lower_bearing;
  for (const char c : id.plane)
    lower_bearing += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string& word : Words(column.name)) {
    for (const std::string& q : called.quantity) {
      quantity = quantity || word == q || word == q + called.which ||
                 word == lower_bearing + q + called.which ||
                 word == q + lower_bearing + called.which;
      which = which || (!called.which.empty() &&
                        (word == q + called.which || word == lower_bearing + q + called.which));
    }
    which = which || word == called.which || word == lower_bearing + called.which ||
            word == called.which + lower_bearing;
    place = place || word == lower_bearing || word == lower_bearing + called.which ||
            word.starts_with(lower_bearing);
    // A duty that is told from a voltage by its word, a velocity from a place.
    if (duty_words && word == "duty") score += 2;
    if (word == "velocity" || word == "v" || word == "mps") return 0;
  }
  if (!quantity && !(which && !unit.empty())) return 0;
  if (!place || (!which && !alone)) return 0;
  return score + 2 * quantity + 2 * which + (unit.empty() ? 0 : 2);
}

std::vector<ChannelId> Wanted(const RigParameters& rig) {
  std::vector<ChannelId> out;
  for (const ChannelKind kind :
       {ChannelKind::kReading, ChannelKind::kCoilCurrent, ChannelKind::kSetPoint,
        ChannelKind::kDuty, ChannelKind::kLoadCell, ChannelKind::kBus})
    for (const ChannelId& id : ChannelsOf(rig, kind)) out.push_back(id);
  return out;
}

}  // namespace

std::vector<ColumnChoice> ChooseColumns(const RigParameters& rig, const Record& record) {
  struct Offer {
    int score;
    std::size_t channel, column;
  };
  const std::vector<ChannelId> wanted = Wanted(rig);
  std::vector<Offer> offers;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const std::string unit(RowOf(wanted[k].kind).unit);
    const bool alone = rig.bearings.size() == 1;
    for (std::size_t c = 0; c < record.channels.size(); ++c) {
      const int score = Score(record.channels[c], wanted[k], NamesOf(wanted[k], unit), alone);
      if (score >= kLeastScore) offers.push_back({score, k, c});
    }
  }
  std::stable_sort(offers.begin(), offers.end(),
                   [](const Offer& a, const Offer& b) { return a.score > b.score; });
  std::vector<bool> channel_done(wanted.size()), column_done(record.channels.size());
  std::vector<ColumnChoice> choices;
  for (const Offer& o : offers) {
    if (channel_done[o.channel] || column_done[o.column]) continue;
    // As good for something else: nothing is said rather than guessed.
    const auto rivals = std::count_if(offers.begin(), offers.end(), [&](const Offer& r) {
      return r.score == o.score && ((r.channel == o.channel) != (r.column == o.column)) &&
             !channel_done[r.channel] && !column_done[r.column];
    });
    if (rivals > 0) continue;
    channel_done[o.channel] = column_done[o.column] = true;
    const Channel& c = record.channels[o.column];
    choices.push_back({wanted[o.channel].name(), c.name, UnitOf(c), 1, 0,
                       o.score == kSameName ? "same name" : "name and unit"});
  }
  std::sort(choices.begin(), choices.end(), [&](const auto& a, const auto& b) {
    const auto at = [&](const std::string& name) {
      return std::find_if(wanted.begin(), wanted.end(),
                          [&](const ChannelId& id) { return id.name() == name; });
    };
    return at(a.channel) < at(b.channel);
  });
  return choices;
}

namespace {

double NumberIn(const std::string& word, const std::string& whole, const char* what) {
  std::size_t used = 0;
  double v = std::nan("");
  try {
    v = std::stod(word, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  if (used != word.size() || !std::isfinite(v))
    throw InputError(fmt::format("--column = {}: {} \"{}\", allowed: a number", whole, what, word));
  return v;
}

}  // namespace

void SayColumn(const std::string& text, const RigParameters& rig, const Record& record,
               std::vector<ColumnChoice>& choices) {
  const std::size_t is = text.find('=');
  if (is == std::string::npos)
    throw InputError(
        fmt::format("--column = {}, allowed: CHANNEL=COLUMN, CHANNEL=COLUMN:UNIT or "
                    "CHANNEL=COLUMN:UNIT:GAIN, e.g. A.x=pos_ax:um:-1",
                    text));
  ColumnChoice c;
  c.channel = text.substr(0, is);
  c.reason = "said";
  std::string names;
  std::optional<ChannelId> known;
  for (const ChannelId& id : Wanted(rig)) {
    names += (names.empty() ? "" : ", ") + id.name();
    if (id.name() == c.channel) known = id;
  }
  if (!known)
    throw InputError(
        fmt::format("--column = {}: channel \"{}\", allowed: {}", text, c.channel, names));
  std::string rest = text.substr(is + 1);
  if (const Channel* whole = FindColumn(record, rest)) {
    c.column = rest;
    c.unit = UnitOf(*whole);
  } else {
    const std::size_t unit = rest.find(':');
    c.column = rest.substr(0, unit);
    rest = unit == std::string::npos ? "" : rest.substr(unit + 1);
    const std::size_t gain = rest.find(':');
    c.unit = rest.substr(0, gain);
    const Channel* found = FindColumn(record, c.column);
    if (!found)
      throw InputError(fmt::format("--column = {}: column \"{}\", allowed: {}", text, c.column,
                                   ColumnsOf(record, c.column)));
    if (c.unit.empty()) c.unit = UnitOf(*found);
    if (gain != std::string::npos) {
      rest = rest.substr(gain + 1);
      const std::size_t offset = rest.find(':');
      c.gain = NumberIn(rest.substr(0, offset), text, "gain");
      if (c.gain == 0)
        throw InputError(fmt::format("--column = {}: gain 0, allowed: a number but 0", text));
      if (offset != std::string::npos) c.offset = NumberIn(rest.substr(offset + 1), text, "offset");
    }
  }
  if (!c.unit.empty())
    UnitFactor(c.unit, RowOf(known->kind).unit, fmt::format("--column = {}", text));
  std::erase_if(choices, [&](const ColumnChoice& o) {
    return o.channel == c.channel || o.column == c.column;
  });
  choices.push_back(c);
}

}  // namespace ambrig
