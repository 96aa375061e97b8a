#include "discovery/data_gate/gate_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/record/channels.h"
#include "discovery/case/case_file.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/model/nuisance_kinds.h"
#include "discovery/model/record_rows.h"
#include "rig/clearance.h"

namespace ambrig {

namespace {
constexpr double kZeroSds = 4;
}

std::vector<GateColumn> ColumnsOf(const CaseModel& model, const std::vector<double>& predicted,
                                  std::size_t record) {
  std::vector<GateColumn> out;
  const CaseRecord& r = model.data().records[record];
  for (const Target& t : model.targets()) {
    if (t.record != record) continue;
    GateColumn c;
    const Channel& channel = r.data.channels[t.channel];
    c.name = channel.name;
    c.floor = t.floor;
    c.column.measured.resize(t.count);
    c.column.predicted.resize(t.count);
    c.column.ok.resize(t.count);
    for (std::size_t k = 0; k < t.count; ++k) {
      const double y = channel.samples[model.sample(t.first + k)];
      c.column.ok[k] = std::isfinite(y) && std::isfinite(predicted[t.first + k]) ? 1 : 0;
      c.column.measured[k] = c.column.ok[k] ? y / t.floor : 0;
      c.column.predicted[k] = c.column.ok[k] ? predicted[t.first + k] / t.floor : 0;
    }
    c.match = MatchOf(c.column);
    out.push_back(std::move(c));
  }
  return out;
}

std::vector<double> ColumnOfRun(const GateColumn& c, const Record& data, const Record& run) {
  const Channel* p = run.Find(c.name);
  if (!p || p->samples.empty()) return {};
  std::vector<double> out(c.column.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = AtRow(p->samples, run.rate, data, k) / c.floor;
  return out;
}

double MostZero(const CaseModel& model, const std::string& channel) {
  const auto& declared = model.data().nuisances.sensor_zero;
  const auto own = declared.find(channel);
  const double usual = UsualZero(model.data().rig, channel);
  return kZeroSds * (own == declared.end() ? usual : std::max(own->second, usual));
}

double LimitOf(const RigParameters& rig, const std::string& channel) {
  const auto id = ParseChannel(channel);
  if (!id) return kInfinity;
  if (id->kind == ChannelKind::kCoilCurrent || id->kind == ChannelKind::kSetPoint)
    return std::max(rig.amplifier.adc_range, rig.amplifier.i_max);
  if (id->kind == ChannelKind::kDuty) return 1;
  if (id->kind == ChannelKind::kBus) return 2 * rig.amplifier.bus_voltage;
  return 2 * GapOfAxis(rig, channel);
}

double ErrorBesideZero(const GateColumn& c, const std::vector<double>& predicted, double zero) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < c.column.size(); ++k)
    if (c.column.ok[k]) sum += c.column.measured[k] - predicted[k], n += 1;
  const double most = zero / c.floor, mean = n > 0 ? std::clamp(sum / n, -most, most) : 0;
  std::vector<double> shifted = predicted;
  for (double& p : shifted) p += mean;
  return ErrorAgainst(c.column.measured, shifted, c.column.ok);
}

std::vector<const GateColumn*> MovingColumns(const std::vector<GateColumn>& columns,
                                             std::size_t most) {
  std::vector<const GateColumn*> out;
  for (const GateColumn& c : columns)
    if (!c.explained && c.match.predicted_move > kMoves && c.match.measured_move > kMoves)
      out.push_back(&c);
  std::stable_sort(out.begin(), out.end(), [](const auto* a, const auto* b) {
    return a->match.predicted_move > b->match.predicted_move;
  });
  if (out.size() > most) out.resize(most);
  return out;
}

Others OthersOf(const std::vector<GateColumn>& columns, const GateColumn& of) {
  constexpr std::size_t kFew = 4;
  const auto bearing = [](const std::string& name) { return name.substr(0, name.find('.')); };
  std::vector<double> near, all;
  for (const GateColumn& c : columns) {
    if (&c == &of) continue;
    all.push_back(c.match.error);
    if (bearing(c.name) == bearing(of.name)) near.push_back(c.match.error);
  }
  if (all.empty()) return {};
  const bool few = near.size() < kFew;
  return {MedianOf(std::move(few ? all : near)), !few};
}

bool BorneOut(const std::vector<GateColumn>& columns, const GateColumn& c) {
  constexpr double kApart = 0.3;  // of the error of the column
  auto id = ParseChannel(c.name);
  if (!id || (id->kind != ChannelKind::kCoilCurrent && id->kind != ChannelKind::kSetPoint))
    return false;
  id->kind =
      id->kind == ChannelKind::kSetPoint ? ChannelKind::kCoilCurrent : ChannelKind::kSetPoint;
  const auto other = std::ranges::find(columns, id->name(), &GateColumn::name);
  if (other == columns.end()) return false;
  std::vector<double> shown = other->column.measured;
  for (double& v : shown) v *= other->floor / c.floor;
  return ErrorAgainst(c.column.measured, shown, c.column.ok) < kApart * c.match.error;
}

DataFault FaultLeaving(const CaseRecord& r, const std::string& channel, const std::string& fault,
                       double left) {
  DataFault f;
  f.record = r.data_file;
  f.channel = channel;
  f.fault = fault;
  f.probability = std::clamp(1 - left * left, 0.5, 0.999);
  return f;
}

DataFault FactorFault(const CaseRecord& r, const std::string& channel, double factor, double left) {
  DataFault f = FaultLeaving(r, channel, factor < 0 ? "sign" : "unit", left);
  f.factor = factor;
  f.mend = UnitLine(r, channel, factor);
  return f;
}

std::string LeaveOutLine(const CaseRecord& r, std::size_t first, std::size_t count) {
  return fmt::format("leave_out = [[{:.6g}, {:.6g}]]", r.data.TimeAt(first) - 0.5 / r.data.rate,
                     r.data.TimeAt(first + count) + 0.5 / r.data.rate);
}

void TellHeld(const CaseRecord& r, const std::string& channel, const HeldStretch& s,
              std::vector<DataFault>& out) {
  DataFault f;
  f.record = r.data_file;
  f.channel = channel;
  f.fault = s.value == 0 ? "lost" : "freeze";
  f.seconds = static_cast<double>(s.count) / r.data.rate;
  f.mend = LeaveOutLine(r, s.first, s.count - 1);
  f.probability = 0.99;
  out.push_back(f);
}

std::string ScenarioLine(const CaseModel& model, const std::string& scenario_file) {
  const std::string folder = std::filesystem::path(model.data().file).parent_path().string();
  return fmt::format("scenario = \"{}\"", NameFrom(folder, scenario_file));
}

void TellScenario(DataFault fault, std::vector<DataFault>& out) {
  std::erase_if(out, [&](const DataFault& told) {
    return told.record == fault.record && told.fault == fault.fault && told.with.empty();
  });
  out.push_back(std::move(fault));
}

}  // namespace ambrig
