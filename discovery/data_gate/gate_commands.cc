// What a scenario commands and no model predicts: set-points of a held rotor, the angle of a
// prescribed speed.
#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/model/record_rows.h"
#include "discovery/model/record_traits.h"

namespace ambrig {

namespace {

/// Of the largest command: drivers round, and the clocks of commands and rows differ by a row.
constexpr double kCommandFloor = 1e-3;
constexpr double kLeastCommandStep = 1e-5;  // of the converter's range

GateColumn CommandColumn(const RigParameters& rig, const CaseRecord& r, const Channel& measured,
                         const Channel& commanded, double rate) {
  GateColumn out;
  out.name = measured.name;
  double most = 0;
  for (std::size_t k = 0; k < measured.samples.size(); ++k) {
    const double y = measured.samples[k];
    out.column.ok.push_back(std::isfinite(y) ? 1 : 0);
    out.column.measured.push_back(std::isfinite(y) ? y : 0);
    out.column.predicted.push_back(AtRow(commanded.samples, rate, r.data, k));
    most = std::max(most, std::abs(out.column.predicted.back()));
  }
  out.floor = std::max(kCommandFloor * most, kLeastCommandStep * rig.amplifier.adc_range);
  for (double& v : out.column.measured) v /= out.floor;
  for (double& v : out.column.predicted) v /= out.floor;
  out.match = MatchOf(out.column);
  return out;
}

/// Set-points of a held rotor beside what its scenario makes of them, and behind them the record's
/// currents, which bear them out but are judged elsewhere.
std::vector<GateColumn> CommandColumns(const CaseModel& model, const Hypothesis& h,
                                       std::size_t record, const std::vector<GateColumn>& columns) {
  const CaseRecord& r = model.data().records[record];
  std::vector<std::string> names;
  for (std::size_t k = 0; k < r.data.channels.size(); ++k)
    if (r.quality[k].use && IsOfKind(r.data.channels[k].name, ChannelKind::kSetPoint))
      names.push_back(r.data.channels[k].name);
  std::vector<GateColumn> out;
  if (names.empty()) return out;
  const Record commanded = model.Simulated(h, record, false, 1, names);
  for (const std::string& name : names)
    if (const Channel* c = commanded.Find(name); c && !c->samples.empty())
      out.push_back(CommandColumn(model.data().rig, r, *r.data.Find(name), *c, commanded.rate));
  for (const GateColumn& c : columns) {
    if (!IsOfKind(c.name, ChannelKind::kCoilCurrent)) continue;
    out.push_back(c);
    out.back().explained = true;
  }
  return out;
}

}  // namespace

void CheckCommands(const CaseModel& model, const Hypothesis& h, std::size_t record,
                   const std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const bool whole = std::ranges::any_of(out, [](const DataFault& f) { return f.channel.empty(); });
  // the record's clock or its scenario is wrong already
  if (r.scenario.start != StartState::kClamped || r.imposed != Imposed::kNothing || whole) return;
  std::vector<GateColumn> commands = CommandColumns(model, h, record, columns);
  CheckUnits(model, record, commands, out);
  CheckSwaps(model, record, commands, out);
}

void CheckDrives(const CaseModel& model, std::size_t record, std::vector<DataFault>& out) {
  constexpr double kMostRows = 0.5;  // a unit is wrong in all of them, also in those near zero
  constexpr double kBeyond = 2;      // times the largest value that the channel can show
  const CaseRecord& r = model.data().records[record];
  if (r.imposed == Imposed::kNothing) return;
  for (const Channel& c : r.data.channels) {
    const double limit = kBeyond * LimitOf(model.data().rig, c.name);
    if (IsPredicted(r, c.name) || !std::isfinite(limit)) continue;
    std::vector<double> sizes;
    for (const double v : c.samples)
      if (std::isfinite(v)) sizes.push_back(std::abs(v));
    if (sizes.empty() || QuantileOf(sizes, kMostRows) < limit) continue;
    const double largest = QuantileOf(sizes, 1);
    for (const double factor : {1e3, 1e6}) {
      if (largest / factor > limit) continue;
      out.push_back(FactorFault(r, c.name, factor, limit / largest));
      break;
    }
  }
}

}  // namespace ambrig
