// Records of kind "static": a table of positions and currents that were set, and what was read.
#include "discovery/case/static_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/inputs_read.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "core/record/column_names.h"
#include "core/record/text_table.h"
#include "core/record/units.h"
#include "discovery/case/case_channels.h"
#include "rig/clearance.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

/// Columns that a table of this rig may have, with their SI unit.
struct TableColumns {
  std::map<std::string, std::string> inputs, outputs;
};

/// `mapped`: the channels that the record maps, among them impedances at a frequency of their own.
TableColumns ColumnsOfRig(const RigParameters& rig, const std::optional<TomlTable>& mapped) {
  TableColumns out;
  out.inputs[kFrequencyColumn] = "Hz";
  for (const ChannelKind kind : {ChannelKind::kReading, ChannelKind::kCoilCurrent})
    for (const ChannelId& id : ChannelsOf(rig, kind)) out.inputs[id.name()] = id.row().unit;
  for (const ChannelId& id : ChannelsOf(rig, ChannelKind::kLoadCell))
    out.outputs[id.name()] = id.row().unit;
  for (const BearingParameters& b : rig.bearings)
    for (int j = 1; j <= b.coils(); ++j) {
      out.outputs[fmt::format("{}.L{}", b.name, j)] = "H";
      out.outputs[fmt::format("{}.R{}", b.name, j)] = "ohm";
      out.outputs[fmt::format("{}.lambda{}", b.name, j)] = "Wb";
    }
  if (!mapped) return out;
  for (const std::string& key : mapped->Keys()) {
    const auto it = out.outputs.find(key.substr(0, key.find('@')));
    if (key.find('@') == std::string::npos || it == out.outputs.end()) continue;
    if ((it->second != "H" && it->second != "ohm") || !(MeterFrequency(key) > 0))
      mapped->Fail(key,
                   "is no impedance at a frequency, allowed: A.L1@1000 or A.R1@1000 for 1000 Hz");
    out.outputs[key] = it->second;
  }
  return out;
}

Record ReadColumns(const std::string& path, Case& c) {
  NoteInput(path);
  TextTable table = ReadTextTable(path, ReadFile(path));
  Record out;
  out.rate = 1;  // rows of a table follow each other, nothing more
  out.channels = std::move(table.columns);
  for (const std::string& note : table.notes) c.notes.push_back(note);
  return out;
}

/// What the case knows of one output: sd of its own, of the record, of the case; accuracy.
struct OutputKnowledge {
  double sd = 0, accuracy = 0;
  bool known() const { return sd > 0 || accuracy > 0; }
};

OutputKnowledge KnowledgeOf(const std::string& output, const std::string& unit, const Case& c,
                            const TomlTable& t) {
  OutputKnowledge k;
  if (const auto it = c.noise.find(output); it != c.noise.end()) k.sd = it->second;
  if (const auto sd = t.Table("sd"); sd && sd->Has(output))
    k.sd = Within(*sd, output, kRequired, {unit, 1e-15, 1e9, "sd of a reading"});
  k.accuracy = Within(t, "accuracy", 0, {"-", 0, 1, "of a reading, beside its sd"});
  return k;
}

/// Every output over its sd. Where nothing is known of it all rows weigh the same.
void WeighRows(CaseRecord& r) {
  for (std::size_t o = 0; o < r.table.outputs.size(); ++o) {
    Channel channel{r.table.outputs[o].name, "-", {}};
    ChannelQuality quality{channel.name, "good", true, {}, 0, 0};
    for (std::size_t k = 0; k < r.table.outputs[o].samples.size(); ++k) {
      channel.samples.push_back(r.table.outputs[o].samples[k] / r.table.sd[o][k]);
      bool ok = std::isfinite(channel.samples.back());
      for (const Channel& in : r.table.inputs) ok = ok && std::isfinite(in.samples[k]);
      quality.ok.push_back(ok ? 1 : 0);
      quality.missing += ok ? 0 : 1;
    }
    r.data.channels.push_back(std::move(channel));
    r.quality.push_back(std::move(quality));
  }
}

void Knowledge(const TomlTable& t, const Case& c, StaticTable& table) {
  for (const Channel& out : table.outputs) {
    const OutputKnowledge known = KnowledgeOf(out.name, out.unit, c, t);
    double largest = 0;
    for (const double v : out.samples)
      if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    table.sd_known.push_back(known.known() ? 1 : 0);
    table.sd.emplace_back();
    for (const double v : out.samples) {
      const double sd = std::hypot(known.sd, known.accuracy * (std::isfinite(v) ? v : 0));
      table.sd.back().push_back(known.known() ? std::max(sd, 1e-12 * largest)
                                              : std::max(largest, 1e-300));
    }
  }
  if (const auto sd = t.Table("sd"))
    for (const std::string& key : sd->Keys())
      if (std::ranges::find(table.outputs, key, &Channel::name) == table.outputs.end())
        sd->Fail(key, "is no output of this table");
}

const Channel* InputNamed(const StaticTable& table, const std::string& name) {
  const auto it = std::ranges::find(table.inputs, name, &Channel::name);
  return it == table.inputs.end() ? nullptr : &*it;
}

/// A gap may be closed: a plunger on its seat.
constexpr double kClosed = 1 - 1e-9;

/// A position that was set stands between the poles, or its unit, gain or offset is wrong.
void RefusePositionsInPoles(const TomlTable& t, const Case& c, const CaseRecord& r) {
  for (const BearingParameters& b : c.rig.bearings) {
    const Channel *x = InputNamed(r.table, b.name + ".x"), *y = InputNamed(r.table, b.name + ".y");
    const std::size_t rows = x ? x->samples.size() : y ? y->samples.size() : 0;
    for (std::size_t k = 0; k < rows; ++k) {
      const double at_x = x ? x->samples[k] : 0, at_y = y ? y->samples[k] : 0;
      if (!std::isfinite(at_x) || !std::isfinite(at_y) ||
          !InPole(b, kClosed * at_x, kClosed * at_y))
        continue;
      t.Fail("data",
             fmt::format("= {}: row {}: {} at [{:g}, {:g}] m, allowed: inside the gap of {} m "
                         "(unit, gain and offset in [record.channels])",
                         r.data_file, k + 1, b.name, at_x, at_y, GapOf(b)));
    }
  }
}

}  // namespace

void ReadStaticRecord(const TomlTable& t, Case& c, CaseRecord& r) {
  r.kind = RecordKind::kStatic;
  if (t.Has("scenario")) {
    r.scenario_file = ExistingFile(t, "scenario");
    r.scenario = ReadScenario(r.scenario_file, c.rig);
    if (r.scenario.start != StartState::kClamped)
      t.Fail("scenario", "does not hold the rotor, allowed: start \"clamped\"");
  } else {
    r.scenario.name = "held rotor";
    r.scenario.rig_file = c.rig_file;
    r.scenario.start = StartState::kClamped;
    r.scenario.duration = 1;
    r.scenario.record_rate = c.rig.controller.rate;
  }
  const TableColumns allowed = ColumnsOfRig(c.rig, t.Table("channels"));
  std::map<std::string, std::string> known = allowed.inputs;
  known.insert(allowed.outputs.begin(), allowed.outputs.end());
  const Record mapped =
      MapChannels(ReadColumns(r.data_file, c), ReadMapping(t, known), known, t, c, r.sources);
  for (const Channel& ch : mapped.channels)
    (allowed.inputs.contains(ch.name) ? r.table.inputs : r.table.outputs).push_back(ch);
  if (r.table.outputs.empty())
    t.Fail("data", fmt::format("= {} holds no force or inductance of this rig, allowed: columns "
                               "A.fx, A.fy [N], A.L1, A.L1@1000 [H], A.R1@1000 [ohm], A.lambda1 "
                               "[Wb], named or mapped in "
                               "[record.channels]",
                               r.data_file));
  RefusePositionsInPoles(t, c, r);
  Knowledge(t, c, r.table);
  r.data.rate = 1;
  WeighRows(r);
  for (const ChannelQuality& q : r.quality)
    if (q.missing > 0)
      c.notes.push_back(fmt::format("{}: {}: {} of {} rows left out (no number)", r.data_file,
                                    q.channel, q.missing, q.ok.size()));
}

}  // namespace ambrig
