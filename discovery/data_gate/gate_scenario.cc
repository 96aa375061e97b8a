// Scenarios: records that another command made.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

namespace {

/// Error of the moving columns of `data` against predictions by name at any rate, over their
/// movement.
double ErrorAgainstRecord(const std::vector<const GateColumn*>& moving, const Record& data,
                          const Record& other) {
  double sum = 0, n = 0;
  for (const GateColumn* c : moving) {
    const std::vector<double> predicted = ColumnOfRun(*c, data, other);
    if (predicted.empty()) return kInfinity;
    sum += std::pow(
        ErrorAgainst(c->column.measured, predicted, c->column.ok) / c->match.measured_move, 2);
    n += 1;
  }
  return n > 0 ? std::sqrt(sum / n) : kInfinity;
}

}  // namespace

void CheckLength(const CaseModel& model, std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  if (r.behind < 2 / r.data.rate) return;
  DataFault f;
  f.record = r.data_file;
  f.fault = "scenario";
  f.seconds = r.behind;
  const double end = r.data.TimeAt(r.data.rows() - 1);
  f.mend = fmt::format("leave_out = [[{:.6g}, {:.6g}]]", end + 0.5 / r.data.rate,
                       end + r.behind + 1 / r.data.rate);
  f.probability = 0.9;
  out.push_back(f);
}

void CheckScenario(const CaseModel& model, const Hypothesis& h, std::size_t record,
                   std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  if (r.scenario.start == StartState::kResting) return;
  std::vector<const GateColumn*> moving;
  double correlation = 0, error = 0;
  for (const GateColumn& c : columns)
    if (!c.explained && c.match.measured_move > kMoves && c.match.error > kGrossError)
      moving.push_back(&c);
  if (moving.size() < 2) return;
  for (const GateColumn* c : moving) {
    correlation += c->match.correlation / static_cast<double>(moving.size());
    error +=
        std::pow(c->match.error / c->match.measured_move, 2) / static_cast<double>(moving.size());
  }
  error = std::sqrt(error);
  if (correlation > 0.5 || error < 0.7) return;
  DataFault f;
  f.record = r.data_file;
  f.fault = "scenario";
  double least = 0.35 * error;
  for (std::size_t k = 0; k < model.data().records.size(); ++k) {
    const CaseRecord& o = model.data().records[k];
    if (k == record || !OverTime(o) || o.scenario.start == StartState::kResting ||
        o.scenario_file == r.scenario_file)
      continue;
    try {
      const Record p = model.Simulated(h, k, false, 1);
      const double left = ErrorAgainstRecord(moving, r.data, p);
      if (left >= least) continue;
      least = left;
      f.with = o.scenario_file;
      f.probability = std::clamp(1 - std::pow(left / error, 2), 0.5, 0.999);
    } catch (const std::runtime_error&) {
      continue;  // that scenario cannot be run
    }
  }
  const bool strange = correlation < 0.15 && [&] {
    const auto n = std::count_if(moving.begin(), moving.end(), [](const GateColumn* c) {
      return c->match.predicted_move > 3 * kMoves;
    });
    return n >= 4 && 2 * n > static_cast<long>(columns.size());
  }();
  if (f.with.empty() && !strange) return;
  if (f.with.empty()) f.probability = 0.9;
  f.mend = f.with.empty() ? "" : ScenarioLine(model, f.with);
  TellScenario(f, out);
  for (GateColumn& c : columns) c.explained = true;
}

}  // namespace ambrig
