#include "discovery/case/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <tuple>

#include "core/base/coil_name.h"
#include "core/base/counted.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "core/record/channels.h"
#include "core/record/read_record.h"
#include "discovery/case/case_channels.h"
#include "discovery/case/case_file.h"
#include "discovery/case/record_span.h"
#include "discovery/case/response_record.h"
#include "discovery/case/static_record.h"
#include "rig/rig_channels.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

/// Noise above this is no noise of that quantity [SI].
double LargestNoise(const std::string& unit) {
  if (unit == "m") return 0.1;
  if (unit == "A") return 1e4;
  if (unit == "V") return 1e5;
  if (unit == "N") return 1e6;
  if (unit == "rad/s") return 1e4;
  return 10;  // duty, rad
}

void CheckAgainstScenario(const CaseRecord& r, const TomlTable& t) {
  if (r.data.start > r.scenario.duration)
    t.Fail("data", fmt::format("starts at {:.6g} s, the scenario {} lasts {} s", r.data.start,
                               r.scenario_file, r.scenario.duration));
  if (r.data.rows() < 8)
    t.Fail("data", fmt::format("has {}, allowed: at least 8", Counted(r.data.rows(), "row")));
  if (r.data.start < -1e-9)
    t.Fail("data", fmt::format("ends at {:.6g} s, before the scenario begins",
                               r.data.TimeAt(r.data.rows() - 1)));
}

/// Whether something moves this coil's current in a clamped record: more than one constant
/// set-point.
bool Moved(const Scenario& s, const std::string& channel) {
  const auto id = ParseChannel(channel);
  if (!id || id->kind != ChannelKind::kCoilCurrent) return false;
  const std::string coil = CoilName(id->plane, id->index);
  return std::any_of(s.excitations.begin(), s.excitations.end(), [&](const Excitation& e) {
    return e.target == coil && !(e.kind == "step" && e.start <= 0);
  });
}

double PositiveNumber(const TomlTable& t, const std::string& key) {
  const double v = t.Number(key, 0);
  if (!(v >= 0 && std::isfinite(v))) t.Fail(key, fmt::format("= {}, allowed: 0 or more", v));
  return v;
}

const char* UsedAs(const CaseRecord& r) {
  return r.test ? "a test" : r.validate ? "validated" : "fitted";
}

/// A record that is fitted says nothing when it validates, and one that was chosen by nothing when
/// it tests.
void RejectReused(const Case& c, const CaseRecord& r, const TomlTable& t) {
  std::error_code ignored;
  for (const CaseRecord& other : c.records)
    if ((other.validate != r.validate || other.test != r.test) &&
        std::filesystem::equivalent(other.data_file, r.data_file, ignored))
      t.Fail("data", fmt::format("= {} is {} and {}, allowed: a record that the {} does not see",
                                 r.data_file, UsedAs(other), UsedAs(r),
                                 other.validate && r.validate ? "search" : "fit"));
}

/// Positions that drive the gaps must be there, of every axis of a bearing that the record knows.
void CheckImposedMotion(const CaseRecord& r, const RigParameters& rig, const TomlTable& t) {
  std::string missing;
  bool any = false;
  for (const std::string& axis : AxisNames(rig))
    if (r.data.Find(axis))
      any = true;
    else if (!r.scenario.clamp.contains(axis.substr(0, axis.find('.'))))
      missing += (missing.empty() ? "" : ", ") + axis;
  if (!any || !missing.empty())
    t.Fail("imposed", fmt::format("= \"motion\" without {}, allowed: positions of all axes, "
                                  "measured or held by the scenario (start \"clamped\")",
                                  any ? missing : "any position"));
  const bool set_points = std::ranges::any_of(
      r.data.channels, [](const Channel& c) { return IsOfKind(c.name, ChannelKind::kSetPoint); });
  if (!set_points && r.scenario.start != StartState::kClamped)
    t.Fail(
        "imposed",
        "= \"motion\" without measured set-points, allowed: a scenario with start \"clamped\" that "
        "commands the coils ([[excitation]] port \"current\" or \"duty\")");
  if (!r.scenario.faults.empty())
    t.Fail("imposed", "= \"motion\" of a scenario with faults, allowed: one without");
}

/// Currents of all coils, and positions of all axes: the gaps, and what is compared.
void CheckImposedCurrents(CaseRecord& r, const RigParameters& rig, const TomlTable& t) {
  std::string missing;
  const auto need = [&](const std::string& name) {
    if (!r.data.Find(name)) missing += (missing.empty() ? "" : ", ") + name;
  };
  for (const BearingParameters& b : rig.bearings)
    for (const ChannelId& id : ChannelsOf(b, ChannelKind::kCoilCurrent)) need(id.name());
  for (const std::string& axis : AxisNames(rig)) need(axis);
  if (!missing.empty())
    t.Fail("imposed", fmt::format("= \"currents\" without {}, allowed: currents of all coils and "
                                  "positions of all axes",
                                  missing));
  if (r.scenario.start == StartState::kClamped)
    t.Fail("imposed", "= \"currents\" of a clamped rotor, allowed: start \"levitated\"");
  if (!r.scenario.faults.empty())
    t.Fail("imposed", "= \"currents\" of a scenario with faults, allowed: one without");
  r.observer = Within(t, "observer", r.observer,
                      {"Hz", 0.1, 1e4, "how fast the rotor follows the measured positions"});
}

NuisancePriors ReadNuisances(const TomlTable& root,
                             const std::map<std::string, std::string>& known) {
  NuisancePriors n;
  const auto t = root.Table("nuisance");
  if (!t) return n;
  if (const auto zero = t->Table("sensor_zero"))
    for (const std::string& channel : zero->Keys()) {
      if (!known.contains(channel)) zero->Fail(channel, "is no channel of this rig");
      n.sensor_zero[channel] = PositiveNumber(*zero, channel);
    }
  n.time_shift = Within(*t, "time_shift", 0, {"s", 0, 1, "sd of a record's clock"});
  n.input_gain = Within(*t, "input_gain", 0, {"-", 0, 1, "sd of the gain of all commands"});
  t->RejectUnknownKeys();
  return n;
}

bool MayBeConstant(const Scenario& s, const std::string& channel) {
  if (s.start == StartState::kClamped) return !Moved(s, channel);
  const auto id = ParseChannel(channel);
  return id && id->row().may_be_constant;
}

void ReadNoise(const TomlTable& root, const std::map<std::string, std::string>& known, Case& c) {
  const auto noise = root.Table("noise");
  if (!noise) return;
  for (const std::string& channel : noise->Keys()) {
    if (!known.contains(channel)) noise->Fail(channel, "is not a channel of this rig");
    const std::string& unit = known.at(channel);
    c.noise[channel] =
        Within(*noise, channel, kRequired, {unit, 0, LargestNoise(unit), "rms of the noise"});
  }
}

/// One [[record]]: its scenario, its data in the rig's channels and what their quality is.
CaseRecord ReadCaseRecord(const TomlTable& t, const std::map<std::string, std::string>& known,
                          Case& c) {
  CaseRecord r;
  r.data_file = ExistingFile(t, "data");
  const std::string use = t.Choice("use", "fit", "fit, validate, test");
  r.validate = use != "fit";
  r.test = use == "test";
  if (const std::string kind = t.Choice("kind", "time", "time, frf, static"); kind != "time") {
    if (kind == "frf")
      ReadResponseRecord(t, c, r);
    else
      ReadStaticRecord(t, c, r);
    RejectReused(c, r, t);
    t.RejectUnknownKeys();
    return r;
  }
  r.scenario_file = ExistingFile(t, "scenario");
  r.scenario = ReadScenario(r.scenario_file, c.rig);
  r.time_offset =
      Within(t, "time_offset", 0, {"s", -1e5, 1e5, "scenario time of the logger's zero"});
  r.data = MapChannels(ReadRecord(r.data_file), ReadMapping(t, known), known, t, c, r.sources);
  const auto left_out = t.Rows("leave_out");
  const std::string imposed = t.Choice("imposed", "none", "none, motion, currents");
  if (imposed == "motion") {
    r.imposed = Imposed::kMotion;
    CheckImposedMotion(r, c.rig, t);
  } else if (imposed == "currents") {
    r.imposed = Imposed::kCurrents;
    CheckImposedCurrents(r, c.rig, t);
  } else if (t.Has("observer")) {
    t.Fail("observer", "belongs to imposed = \"currents\"");
  }
  RejectReused(c, r, t);
  t.RejectUnknownKeys();
  r.data.start += r.time_offset;
  LeaveOutSpans(r, left_out, t);
  CutToScenario(r, c.notes);
  if (r.data.channels.empty())
    t.Fail("data", fmt::format("= {} contains no channel of this rig", r.data_file));
  CheckAgainstScenario(r, t);
  const std::size_t empty = EmptyRows(r);
  for (const auto& [from, to] : r.gaps)
    c.notes.push_back(
        fmt::format("{}: no rows between {:.6g} s and {:.6g} s", r.data_file, from, to));
  for (const Channel& ch : r.data.channels) {
    r.quality.push_back(InspectChannel(ch, MayBeConstant(r.scenario, ch.name)));
    const ChannelQuality& q = r.quality.back();
    if (q.missing == empty && q.clipped == 0 && q.use) continue;  // told of the record
    if (!q.verdict.starts_with("good"))
      c.notes.push_back(fmt::format("{}: {}: {}", r.data_file, ch.name, q.verdict));
  }
  return r;
}

/// What a record tells that others of its sort tell as well.
std::tuple<RecordKind, StartState, Imposed, bool, bool> SortOf(const CaseRecord& r) {
  const bool turns = r.kind == RecordKind::kTime &&
                     r.scenario.speed.LargestSpeed(r.scenario.duration) > 0,
             forces = std::ranges::any_of(r.data.channels, [](const Channel&ch) {
               return IsOfKind(ch.name, ChannelKind::kLoadCell);
             });
  return {r.kind, r.scenario.start, r.imposed, turns, forces};
}

/// Without any record marked "validate" every third one is kept back for that, but none that the
/// fits cannot do without: of its sort another one must be left to them. Records of the test are no
/// part of this.
void ReserveForValidation(Case& c) {
  const bool any =
      std::ranges::any_of(c.records, [](const CaseRecord& r) { return r.validate && !r.test; });
  const auto records = static_cast<std::size_t>(
      std::ranges::count_if(c.records, [](const CaseRecord& r) { return !r.test; }));
  if (any || (records <= 2 && records == c.records.size())) return;
  std::map<decltype(SortOf(c.records[0])), int> left;
  for (const CaseRecord& r : c.records)
    if (!r.test) ++left[SortOf(r)];
  std::size_t since = 0, reserved = 0;
  for (CaseRecord& r : c.records) {
    if (r.test || ++since < 3 || left[SortOf(r)] < 2) continue;
    --left[SortOf(r)];
    r.validate = true;
    since = 0;
    ++reserved;
  }
  const std::string beside = records < c.records.size() ? " beside the records of the test" : "";
  c.notes.push_back(reserved > 0
                        ? fmt::format("no record is marked \"validate\": {} of {} are reserved for "
                                      "validation{}",
                                      reserved, records, beside)
                        : "no record is marked \"validate\" and none can be spared: what fits is "
                          "not validated" +
                              beside);
}

Case CaseOfTable(const TomlTable& root, const std::string& file) {
  Case c;
  c.file = file;
  c.rig_file = ExistingFile(root, "rig", "rig.toml");
  c.rig = ReadRig(c.rig_file);
  const auto known = KnownChannels(c.rig);
  ReadNoise(root, known, c);
  c.nuisances = ReadNuisances(root, known);
  const auto tables = root.Tables("record");
  if (tables.empty())
    root.Fail("record", "is missing, allowed: one or more [[record]] with scenario and data");
  for (const TomlTable& t : tables) c.records.push_back(ReadCaseRecord(t, known, c));
  root.RejectUnknownKeys();
  if (std::all_of(c.records.begin(), c.records.end(), [](const auto& r) { return r.validate; }))
    root.Fail("record", "has no record with use = \"fit\", allowed: at least one");
  ReserveForValidation(c);
  return c;
}

}  // namespace

Case ReadCase(const std::string& path) {
  const std::string file = std::filesystem::is_directory(path)
                               ? (std::filesystem::path(path) / "case.toml").string()
                               : path;
  return CaseOfTable(TomlTable::FromFile(file), file);
}

Case ReadCaseText(const std::string& text, const std::string& file) {
  return CaseOfTable(TomlTable::FromText(text, file), file);
}

}  // namespace ambrig
