// Static tables: outputs, or what was set, with a wrong sign or in a wrong unit.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/record/channels.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_points.h"

namespace ambrig {

namespace {

constexpr double kGrossOfTable = 0.25;  // relative error, whatever the noise
constexpr std::size_t kFewestRows = 4;
// of what mistakes in the outputs leave, that one in what was set may leave to be told in their
// place
constexpr double kAsGood = 1.3, kClearlyBetter = 0.7;
constexpr double kLeftOfTable = 0.15, kLeftOfAnyFactor = 0.08;  // of the relative error

/// One output over its sd beside what the model expects of it.
struct OutputColumn {
  std::string name;
  MatchedColumn column;
  double error = 0;  // rms of the difference over that of both
  bool gross = false;
};

double RelativeErrorOf(const MatchedColumn& c, const std::vector<double>& expected, double factor) {
  double different = 0, sizes = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.ok[k]) continue;
    different += std::pow(c.measured[k] - factor * expected[k], 2);
    sizes += std::pow(c.measured[k], 2) + std::pow(factor * expected[k], 2);
  }
  return sizes > 0 ? std::sqrt(different / sizes) : 0;
}

std::vector<OutputColumn> OutputsOf(const CaseModel& model, const std::vector<double>& predicted,
                                    std::size_t record) {
  std::vector<OutputColumn> out;
  const CaseRecord& r = model.data().records[record];
  for (const Target& t : model.targets()) {
    if (t.record != record) continue;
    OutputColumn c;
    c.name = r.data.channels[t.channel].name;
    std::size_t rows = 0;
    double square = 0;
    for (std::size_t k = 0; k < t.count; ++k) {
      const double m = model.measured()[t.first + k], p = predicted[t.first + k];
      const bool ok = model.ok()[t.first + k] && std::isfinite(p);
      c.column.measured.push_back(ok ? m : 0);
      c.column.predicted.push_back(ok ? p : 0);
      c.column.ok.push_back(ok ? 1 : 0);
      rows += ok ? 1 : 0;
      square += ok ? (m - p) * (m - p) : 0;
    }
    c.error = RelativeErrorOf(c.column, c.column.predicted, 1);
    const bool known = r.table.sd_known[t.channel] != 0;
    const double floors =
        known && rows > 0 ? std::sqrt(square / static_cast<double>(rows)) / t.floor : kInfinity;
    c.gross = rows >= kFewestRows && c.error > kGrossOfTable && floors > kGrossError;
    out.push_back(std::move(c));
  }
  return out;
}

double ErrorOfOutputs(const std::vector<OutputColumn>& all) {
  double sum = 0;
  for (const OutputColumn& c : all) sum += c.error * c.error;
  return std::sqrt(sum / static_cast<double>(all.size()));
}

struct TableFactor {
  double factor = 1, left = 1;  // of the relative error
};

/// The factor of an output that leaves the least; 1 where none is believed. Other outputs that err
/// too may be the machine's doing: then only a sign or a prefix is.
TableFactor FactorOf(const OutputColumn& c, bool alone) {
  constexpr double kMostOfMachine = 1.6, kNear = 0.05;
  constexpr double kGrams = 1e3 / 9.80665;  // for newtons
  static constexpr std::array kPrefixes = {-1.0, 1e3, 1e-3, 1e6, 1e-6, kGrams};
  static constexpr std::array kOther = {9.80665, 1 / 9.80665, 2.0, 0.5};
  TableFactor best{1, kLeftOfTable};
  const auto attempt = [&](double factor, double most) {
    const double left = RelativeErrorOf(c.column, c.column.predicted, factor) / c.error;
    if (left < std::min(most, best.left)) best = {factor, left};
  };
  for (const double factor : kPrefixes) attempt(factor, kLeftOfTable);
  if (best.factor != 1 || !alone) return best;
  double mp = 0, pp = 0;
  for (std::size_t k = 0; k < c.column.size(); ++k)
    mp += c.column.measured[k] * c.column.predicted[k], pp += std::pow(c.column.predicted[k], 2);
  double factor = pp > 0 ? mp / pp : 1;
  for (const double listed : kOther)
    if (factor > 0 && std::abs(std::log(factor / listed)) < kNear) factor = listed;
  if (factor > 0 && std::abs(std::log(factor)) > std::log(kMostOfMachine))
    attempt(factor, kLeftOfAnyFactor);
  return best;
}

/// Inputs that were multiplied, and what that leaves of all outputs.
struct InputMistake {
  std::vector<std::string> inputs;
  TableFactor found;
};

/// What the model leaves of the outputs if these inputs are `factor` times too large as written; 1
/// where it cannot say.
double LeftWithInputs(const CaseModel& model, const Hypothesis& h, std::size_t record,
                      std::vector<OutputColumn> outputs, const std::vector<std::string>& inputs,
                      double factor) {
  CaseRecord other = model.data().records[record];
  for (Channel& in : other.table.inputs)
    if (std::ranges::find(inputs, in.name) != inputs.end())
      for (double& v : in.samples) v /= factor;
  const double before = ErrorOfOutputs(outputs);
  std::vector<std::vector<double>> columns;
  if (!MakePredictor(model.data(), other)->Predict(h.rig, columns)) return 1;
  for (OutputColumn& c : outputs) {
    const auto at = std::ranges::find(other.data.channels, c.name, &Channel::name);
    const auto& expected = columns[static_cast<std::size_t>(at - other.data.channels.begin())];
    if (!std::ranges::all_of(expected, [](double v) { return std::isfinite(v); })) return 1;
    c.error = RelativeErrorOf(c.column, expected, 1);
  }
  return ErrorOfOutputs(outputs) / before;
}

/// All positions or all currents that were set, or one column of them.
InputMistake InputsOf(const CaseModel& model, const Hypothesis& h, std::size_t record,
                      const std::vector<OutputColumn>& outputs) {
  std::vector<std::vector<std::string>> groups;
  const StaticTable& table = model.data().records[record].table;
  for (const ChannelKind kind : {ChannelKind::kReading, ChannelKind::kCoilCurrent}) {
    std::vector<std::string> all;
    for (const Channel& in : table.inputs)
      if (IsOfKind(in.name, kind)) all.push_back(in.name);
    for (const std::string& one : all) groups.push_back({one});
    if (all.size() > 1) groups.push_back(all);
  }
  InputMistake best;
  best.found.left = kLeftOfTable;
  for (const std::vector<std::string>& group : groups)
    for (const double factor : {-1.0, 1e3, 1e-3}) {
      // positions a thousand times as far out lie in the poles
      if (factor < 1 && factor > 0 && IsOfKind(group[0], ChannelKind::kReading)) continue;
      const double left = LeftWithInputs(model, h, record, outputs, group, factor);
      if (left < best.found.left) best = {group, {factor, left}};
    }
  return best;
}

}  // namespace

void CheckTable(const CaseModel& model, const std::vector<double>& predicted, const Hypothesis& h,
                std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const std::vector<OutputColumn> outputs = OutputsOf(model, predicted, record);
  const auto wrong = std::ranges::count_if(outputs, &OutputColumn::gross);
  if (wrong == 0) return;
  std::vector<std::pair<std::string, TableFactor>> found;
  double left = 0, largest = 0;
  for (const OutputColumn& c : outputs) {
    if (!c.gross) continue;
    const bool alone = std::ranges::all_of(outputs, [&](const OutputColumn& other) {
      return &other == &c || other.error < kAlone * c.error;
    });
    const TableFactor factor = FactorOf(c, alone && outputs.size() > 1);
    if (factor.factor != 1) found.emplace_back(c.name, factor);
    largest = std::max(largest, std::abs(std::log(std::abs(factor.factor))));
    left += std::pow(factor.factor != 1 ? factor.left * c.error : c.error, 2);
  }
  const double each =
      std::sqrt(left / static_cast<double>(outputs.size())) / ErrorOfOutputs(outputs);
  if (wrong > 1 || found.empty()) {
    const InputMistake in = InputsOf(model, h, record, outputs);
    // currents in mA make forces a millionth: the smaller factor is the mistake
    const bool smaller = std::abs(std::log(std::abs(in.found.factor))) < largest;
    if (!in.inputs.empty() && in.found.left < (smaller ? kAsGood : kClearlyBetter) * each) {
      for (const std::string& input : in.inputs)
        out.push_back(FactorFault(r, input, in.found.factor, in.found.left));
      return;
    }
  }
  for (const auto& [column, f] : found) out.push_back(FactorFault(r, column, f.factor, f.left));
}

}  // namespace ambrig
