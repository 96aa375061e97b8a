// Two records whose data files were exchanged: each agrees with the model under the scenario of the
// other one. What the two lead to differs little where both command the same steps.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "discovery/data_gate/gate_checks.h"
#include "discovery/model/record_traits.h"

namespace ambrig {

namespace {

constexpr double kPlainExcess = 0.7;     // mean square over the floor, above that of others
constexpr double kExchangeLeaves = 0.1;  // of that excess, in both records
constexpr std::size_t kLeastColumns = 4;

bool MayBeExchanged(const CaseRecord& r) {
  return OverTime(r) && r.imposed == Imposed::kNothing && r.scenario.faults.empty() &&
         r.scenario.start != StartState::kResting;
}

/// Mean square error of the columns over the floor against `run`; infinity where it lacks one of
/// them.
double MeanSquare(const std::vector<GateColumn>& columns, const Record& data, const Record& run) {
  double sum = 0;
  for (const GateColumn& c : columns) {
    const std::vector<double> predicted = ColumnOfRun(c, data, run);
    if (predicted.empty()) return kInfinity;
    sum += std::pow(ErrorAgainst(c.column.measured, predicted, c.column.ok), 2);
  }
  return sum / static_cast<double>(columns.size());
}

/// A record with its error under its own scenario, and the run of that.
struct RecordRun {
  std::size_t record = 0;
  std::vector<GateColumn> columns;
  double square = 0;  // mean, over the floor
  Record run;
};

/// The records of many columns that the model holds.
std::vector<RecordRun> RunsOf(const CaseModel& model, const std::vector<double>& predicted) {
  std::vector<RecordRun> out;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    if (!MayBeExchanged(model.data().records[r])) continue;
    RecordRun s{r, ColumnsOf(model, predicted, r), 0, {}};
    if (s.columns.size() < kLeastColumns) continue;
    for (const GateColumn& c : s.columns)
      s.square += std::pow(c.match.error, 2) / static_cast<double>(s.columns.size());
    out.push_back(std::move(s));
  }
  return out;
}

/// What all records but two leave at least: parameters that are not fitted yet, noise that is not
/// as stated; 1: the floor.
double LeastOfOthers(const std::vector<RecordRun>& runs, const RecordRun& a, const RecordRun& b) {
  double least = kInfinity;
  for (const RecordRun& r : runs)
    if (&r != &a && &r != &b) least = std::min(least, r.square);
  return std::isfinite(least) ? std::max(1.0, least) : 1;
}

bool MayBeOfEachOther(const CaseRecord& a, const CaseRecord& b) {
  return a.scenario_file != b.scenario_file && a.scenario.start == b.scenario.start &&
         a.scenario.duration == b.scenario.duration;
}

/// The scenario's run; empty where the model loses its rotor.
const Record& RunOf(const CaseModel& model, const Hypothesis& h, RecordRun& of) {
  try {
    if (of.run.channels.empty()) of.run = model.Simulated(h, of.record, false, 1);
  } catch (const std::runtime_error&) {
    of.run.channels.clear();
  }
  return of.run;
}

/// The larger share of their error above that of the others that two records keep when their
/// scenarios are exchanged.
double LeftByOtherScenario(const CaseModel& model, const Hypothesis& h, double others, RecordRun& a,
                           RecordRun& b) {
  const auto left = [&](RecordRun& of, RecordRun& by) {
    const Record& data = model.data().records[of.record].data;
    return (MeanSquare(of.columns, data, RunOf(model, h, by)) - others) / (of.square - others);
  };
  return std::max(left(a, b), left(b, a));
}

void TellExchanged(const CaseModel& model, std::size_t record, std::size_t other, double left,
                   std::vector<DataFault>& out) {
  DataFault f =
      FaultLeaving(model.data().records[record], "", "scenario", std::sqrt(std::max(0.0, left)));
  f.with = model.data().records[other].scenario_file;
  f.mend = ScenarioLine(model, f.with);
  TellScenario(f, out);
}

}  // namespace

void CheckExchangedRecords(const CaseModel& model, const std::vector<double>& predicted,
                           const Hypothesis& h, std::vector<DataFault>& out) {
  std::vector<RecordRun> runs = RunsOf(model, predicted);
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = i + 1; j < runs.size(); ++j) {
      RecordRun &a = runs[i], &b = runs[j];
      const double others = LeastOfOthers(runs, a, b);
      if (!MayBeOfEachOther(model.data().records[a.record], model.data().records[b.record]) ||
          std::min(a.square, b.square) < others + kPlainExcess)
        continue;
      const double left = LeftByOtherScenario(model, h, others, a, b);
      if (left > kExchangeLeaves) continue;
      TellExchanged(model, a.record, b.record, left, out);
      TellExchanged(model, b.record, a.record, left, out);
    }
}

}  // namespace ambrig
