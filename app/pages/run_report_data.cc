#include "app/pages/run_report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "analysis/dropped_modes.h"
#include "app/figures/series.h"
#include "app/text/format.h"
#include "core/base/read_file.h"
#include "core/base/version.h"
#include "fdd/learning/commissioning_file.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

constexpr double kWorthANote = 0.01;  // of the run: an action is followed by some ms of doubt

std::string MilliSeconds(double t) { return t < 0 ? "–" : fmt::format("{:.3g} ms", t * 1e3); }

/// "A.coil3" -> "A3".
std::string ShortTargetName(const std::string& target) {
  const auto dot = target.find(".coil");
  return dot == std::string::npos ? target : target.substr(0, dot) + target.substr(dot + 5);
}

std::vector<double> ChannelOf(const Record& record, const ChannelId& id) {
  const Channel* c = Find(record, id);
  return c ? c->samples : std::vector<double>{};
}

/// A path up to `end` [s] of the record; what comes after is no number.
void EndPath(const Record& record, double end, std::vector<double>* path) {
  for (std::size_t k = 0; k < path->size(); ++k)
    if (record.TimeAt(k) > end) (*path)[k] = std::nan("");
}

void FillBearings(const RigParameters& rig, const RunResult& result, RunReportData& data) {
  for (const BearingParameters& b : rig.bearings) {
    if (!b.kind->two_axes) continue;
    ReportBearing r;
    r.name = b.name;
    r.clearance = ClearanceOf(b);
    r.pole_angles = b.kind->stator(b).Angles();
    r.x = ChannelOf(result.record, {ChannelKind::kTruePosition, b.name, 0});
    r.y = ChannelOf(result.record, {ChannelKind::kTruePosition, b.name, 1});
    for (std::vector<double>* path : {&r.x, &r.y}) EndPath(result.record, ModelEnd(result), path);
    for (const ChannelId& current : ChannelsOf(b, ChannelKind::kCoilCurrent))
      r.currents.push_back(ChannelOf(result.record, current));
    data.bearings.push_back(std::move(r));
  }
}

std::vector<ReportStation> StationsOf(const RigParameters& rig, const RunResult& result) {
  const Record& record = result.record;
  std::vector<ReportStation> stations;
  for (const ShaftPlane& s : rig.stations) {
    ReportStation r{s.name, ChannelOf(record, {ChannelKind::kTruePosition, s.name, 0}),
                    ChannelOf(record, {ChannelKind::kTruePosition, s.name, 1})};
    for (std::vector<double>* path : {&r.x, &r.y}) {
      const double start = path->empty() ? 0 : path->front();  // a heavy shaft hangs through
      for (double& v : *path) v -= start;
      EndPath(record, ModelEnd(result), path);
    }
    if (!r.x.empty()) stations.push_back(std::move(r));
  }
  return stations;
}

void FillSnapshots(const RigParameters& rig, const Scenario& scenario, const RunResult& result,
                   RunReportData& data) {
  for (const FluxSnapshot& s : result.snapshots) {
    const BearingParameters* bearing = rig.Find(s.bearing);  // poles are drawn round a shaft only
    if (!bearing || !bearing->kind->eight_poles) continue;
    ReportSnapshot r;
    r.bearing = s.bearing;
    r.label = s.label;
    r.t = s.t;
    r.flux = s.flux;
    r.current = s.current;
    r.x = s.x;
    r.y = s.y;
    for (const FaultSpec& f : scenario.faults)
      if (f.target.starts_with(s.bearing + ".coil") && f.time <= s.t &&
          s.label.rfind("before", 0) != 0)
        r.failed.push_back(std::stoi(f.target.substr(s.bearing.size() + 5)));
    data.snapshots.push_back(std::move(r));
  }
}

void FillVerdict(const RunResult& result, const std::vector<ExpectResult>& expect,
                 RunReportData& data) {
  const bool met = AllMet(expect);
  data.verdict = !met || result.drop ? Verdict::kFail
                 : result.touchdown  ? Verdict::kWarn
                                     : Verdict::kOk;
  data.verdict_text = result.drop ? "The rotor dropped."
                      : result.touchdown
                          ? "The rotor touched an auxiliary bearing and recovered."
                          : "The rotor stayed up, without touching an auxiliary bearing.";
  if (!expect.empty())
    data.verdict_text += met ? " Every expectation is met." : " An expectation is not met.";
  for (const ExpectResult& e : expect) data.expect.push_back({e.key, e.wanted, e.got, e.met});
}

void FillMetrics(const RunMetrics& m, RunReportData& data) {
  for (const auto& [name, orbit] : m.max_orbit)
    data.metrics.emplace_back("peak orbit " + name, FormatSi(orbit, "m"));
  for (const ReportStation& s : data.stations)
    data.metrics.emplace_back("peak orbit " + s.name, FormatSi(LargestRadius(s.x, s.y), "m"));
  data.metrics.emplace_back("least clearance left", FormatSi(m.min_clearance_left, "m"));
  data.metrics.emplace_back("detection delay", MilliSeconds(m.detection_delay));
  data.metrics.emplace_back("redistribution delay", MilliSeconds(m.redistribution_delay));
  data.metrics.emplace_back("false alarms", FalseAlarmText(m.false_alarms, m.coil_periods));
  data.metrics.emplace_back("peak coil current", FormatSi(m.peak_current, "A"));
  data.metrics.emplace_back("copper loss, mean", FormatSi(m.copper_loss, "W"));
  data.metrics.emplace_back("computed at", fmt::format("{:.1f} x real time", m.real_time_factor));
}

void FillChannels(const Record& record, RunReportData& data) {
  data.theta = ChannelOf(record, {ChannelKind::kAngle});
  const auto rpm = [&](std::vector<double> v) {
    for (double& x : v) x *= 30 / kPi;
    return v;
  };
  data.channels.push_back({"speed", "rpm", rpm(ChannelOf(record, {ChannelKind::kSpeed}))});
  const ChannelId axial{ChannelKind::kReading, "", 2}, bus{ChannelKind::kBus};
  if (Find(record, axial))
    data.channels.push_back(
        {axial.name(), std::string(axial.row().unit), ChannelOf(record, axial)});
  data.channels.push_back({bus.name(), std::string(bus.row().unit), ChannelOf(record, bus)});
}

void FillSlopes(const RunResult& result, RunReportData& data) {
  for (const SlopeTrace& s : result.slopes) {
    ReportSlope r;
    r.coil = ShortTargetName(s.coil);
    r.t = s.t;
    r.slope = s.slope;
    r.low = s.low;
    r.high = s.high;
    data.slopes.push_back(std::move(r));
  }
}

}  // namespace

double ModelEnd(const RunResult& result) {
  for (const RunEvent& e : result.events)
    if (e.kind == "model_invalid") return e.t;
  return kInfinity;
}

std::map<std::string, double> StationOrbits(const RigParameters& rig, const RunResult& result) {
  std::map<std::string, double> out;
  for (const ReportStation& s : StationsOf(rig, result)) out[s.name] = LargestRadius(s.x, s.y);
  return out;
}

std::string DoubtfulModelNote(const RigParameters& rig, const RunResult& result) {
  if (!result.doubtful) return "";
  if (rig.detection.commissioning.empty() &&
      !std::filesystem::exists(CommissioningFileOf(rig.file)))
    return fmt::format(
        "the fault detection has not learnt this rig and acts on gross faults only (no current, "
        "half of the turns); to teach it: ambrig commission {}",
        rig.file);
  std::string shares;
  for (const auto& [bearing, share] : result.doubtful_share)
    if (share >= kWorthANote)
      shares += fmt::format("{}{} {:.3g} %", shares.empty() ? "" : ", ", bearing, 100 * share);
  if (shares.empty()) return "";
  return fmt::format(
      "the fault detection doubted its model, and would have acted on gross faults only, in part "
      "of the run: {}",
      shares);
}

bool HasAuxiliary(const RigParameters& rig) {
  return std::ranges::any_of(rig.bearings, [](const auto& b) { return b.auxiliary.has_value(); });
}

std::string EventText(const RunEvent& e) {
  std::string text = e.fault_class;
  if (e.kind == "redistributed" && text == "exact") text += " (force law as when healthy)";
  if (e.kind == "redistributed" && text == "linearised") text += " (holds near zero force)";
  if (e.kind == "redistributed" && text == "linearised about the load")
    text = "linearised (holds near the weight)";
  if (e.kind == "not_redistributed" && text == "none")
    text += " (no currents of the coils that are left give the forces)";
  if (e.kind == "not_redistributed" && text == "own set-points")
    text += " (the controller commands currents itself)";
  if (e.kind == "not_redistributed" && text == "nothing else carries")
    text = "coil kept in spite of its reading, nothing else carries";
  if (e.kind == "doubtful") text += ": gross faults only";
  if (e.fraction > 0)
    text += fmt::format("{}{:.0f} % of the turns", text.empty() ? "" : ", ", 100 * e.fraction);
  return text;
}

RunReportData MakeRunReportData(const RigParameters& rig, const Scenario& scenario,
                                const RunResult& result, const std::vector<ExpectResult>& expect,
                                const std::string& fidelity) {
  RunReportData data;
  data.name = scenario.name;
  data.subtitle = fmt::format("rig {}, {} fidelity, seed {}, {}", rig.name, fidelity, scenario.seed,
                              ProgramVersion());
  FillVerdict(result, expect, data);
  std::vector<std::string> notes = result.notes;
  if (const std::string note = DoubtfulModelNote(rig, result); !note.empty()) notes.push_back(note);
  for (std::string note : notes) {
    note[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(note[0])));
    data.notes.push_back(note + ".");
  }
  data.stations = StationsOf(rig, result);
  FillMetrics(result.metrics, data);
  if (const auto dropped = FindDroppedModes(rig))
    data.metrics.emplace_back("bending modes", DroppedModesText(*dropped));
  if (!HasAuxiliary(rig))
    std::erase_if(data.metrics, [](const auto& m) { return m.first == "least clearance left"; });
  for (const RunEvent& e : result.events)
    data.events.push_back({e.t, e.kind, ShortTargetName(e.target), EventText(e)});
  data.rate = result.record.rate;
  data.start = result.record.start;
  FillBearings(rig, result, data);
  FillChannels(result.record, data);
  FillSlopes(result, data);
  FillSnapshots(rig, scenario, result, data);
  data.scenario_toml = ReadFile(scenario.file);
  data.rig_toml = ReadFile(rig.file);
  return data;
}

}  // namespace ambrig
