// Columns that were exchanged: each shows what the model expects of the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/gate_columns.h"

namespace ambrig {

namespace {

constexpr double kLeftOfKind = 0.35,
                 kLeftOfOthers = 0.1;  // of the error, columns of one kind and of two
// Beside an effect more may be left where the movements say clearly which column is which.
constexpr double kLeftBesideEffect = 0.6, kOfItself = 0.5, kOfOther = 0.75;

/// The kind of a column; those along the shaft are a kind of their own.
std::pair<ChannelKind, bool> KindOf(const GateColumn& c) {
  const auto id = ParseChannel(c.name);
  return {id->kind, id->row().scope == ChannelScope::kDirection && id->index == 2};
}

/// What the model expects of `b`, in floors of `a`.
std::vector<double> ExpectedOf(const GateColumn& b, const GateColumn& a) {
  std::vector<double> predicted = b.column.predicted;
  for (double& p : predicted) p *= b.floor / a.floor;
  return predicted;
}

/// The data of one column against the prediction of another.
struct Exchanged {
  double error = 0, correlation = 0;
};
Exchanged Against(const CaseModel& model, const GateColumn& a, const GateColumn& b) {
  MatchedColumn column = a.column;
  column.predicted = ExpectedOf(b, a);
  return {ErrorBesideZero(a, column.predicted, MostZero(model, a.name)),
          MatchOf(column).correlation};
}

/// The share of the error that an exchange leaves; 1 where it is not believed.
double LeftByExchange(const CaseModel& model, const GateColumn& a, const GateColumn& b) {
  if (std::min(a.match.error, b.match.error) < 0.7 * kGrossError) return 1;
  const Exchanged own_a = Against(model, a, a), own_b = Against(model, b, b);
  const double before = std::hypot(own_a.error, own_b.error);
  if (std::min(own_a.error, own_b.error) < 0.7 * kGrossError || before < 1.5 * kGrossError)
    return 1;
  const Exchanged a_as_b = Against(model, a, b), b_as_a = Against(model, b, a);
  const double left = std::hypot(a_as_b.error, b_as_a.error) / before;
  const bool one_kind = KindOf(a) == KindOf(b);
  const bool clear = one_kind && std::max(own_a.correlation, own_b.correlation) < kOfItself &&
                     std::min(a_as_b.correlation, b_as_a.correlation) > kOfOther;
  const double most = clear ? kLeftBesideEffect : one_kind ? kLeftOfKind : kLeftOfOthers;
  return left > most ? 1 : left;
}

}  // namespace

void CheckSwaps(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const auto column = [&](const std::string& name) {
    const auto it = r.sources.find(name);
    return it == r.sources.end() ? name : it->second.column;
  };
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = i + 1; j < columns.size(); ++j) {
      GateColumn &a = columns[i], &b = columns[j];
      if (a.explained || b.explained) continue;
      const double left = LeftByExchange(model, a, b);
      if (left >= 1) continue;
      DataFault f;
      f.record = r.data_file;
      f.channel = a.name;
      f.fault = "swap";
      f.with = b.name;
      f.probability = std::clamp(1 - left * left, 0.5, 0.999);
      f.mend = fmt::format("channels = {{ \"{}\" = \"{}\", \"{}\" = \"{}\" }}", a.name,
                           column(b.name), b.name, column(a.name));
      out.push_back(f);
      a.explained = b.explained = true;
    }
}

}  // namespace ambrig
