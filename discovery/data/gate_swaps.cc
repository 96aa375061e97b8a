// Columns that were exchanged: each shows what the model expects of the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/gate_columns.h"

namespace ambrig {

namespace {

// of the error, columns of one kind and of two
constexpr double kLeftOfKind = 0.35, kLeftOfOthers = 0.1;
// of columns that stand still: two numbers that agree by chance leave a third
constexpr double kLeftOfHeld = 0.1;
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

bool StandsStill(const GateColumn& c) {
  return std::max(c.match.measured_move, c.match.predicted_move) < kMoves;
}

/// Whether a third column of their kind that stands still errs by more than so many floors beside its zero: the shaft is
/// elsewhere, or bent, and two positions agree by chance.
bool OtherErrs(const CaseModel& model, const std::vector<GateColumn>& columns, const GateColumn& a,
               const GateColumn& b, double most) {
  return std::ranges::any_of(columns, [&](const GateColumn& c) {
    return c.name != a.name && c.name != b.name && KindOf(c) == KindOf(a) && StandsStill(c) &&
           ErrorBesideZero(c, c.column.predicted, MostZero(model, c.name)) > most;
  });
}

/// Whether a coil really carries what the column shows: its set-point asks for it, and the rest of its bearing errs too.
/// A force of the other sign makes opposite coils look exchanged.
bool CarriedInstead(const std::vector<GateColumn>& columns, const GateColumn& c, double error) {
  return BorneOut(columns, c) && OthersOf(columns, c).error > std::min(kAlone * error, kGrossError);
}

/// The share of the error that an exchange leaves; 1 where it is not believed. `own_a`, `own_b`: errors of the columns
/// beside a zero as they stand [floors].
double LeftByExchange(const CaseModel& model, const std::vector<GateColumn>& columns,
                      const GateColumn& a, double own_a, const GateColumn& b, double own_b) {
  const double before = std::hypot(own_a, own_b);
  if (std::min(own_a, own_b) < 0.7 * kGrossError || before < 1.5 * kGrossError) return 1;
  if (CarriedInstead(columns, a, own_a) && CarriedInstead(columns, b, own_b)) return 1;
  const Exchanged a_as_b = Against(model, a, b), b_as_a = Against(model, b, a);
  const double left = std::hypot(a_as_b.error, b_as_a.error) / before;
  const bool one_kind = KindOf(a) == KindOf(b);
  if (StandsStill(a) && StandsStill(b) &&
      (left > kLeftOfHeld || OtherErrs(model, columns, a, b, kAlone * before)))
    return 1;
  const bool clear = one_kind && std::max(a.match.correlation, b.match.correlation) < kOfItself &&
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
  std::vector<double> own;
  for (const GateColumn& c : columns)
    own.push_back(ErrorBesideZero(c, c.column.predicted, MostZero(model, c.name)));
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = i + 1; j < columns.size(); ++j) {
      GateColumn &a = columns[i], &b = columns[j];
      if (a.explained || b.explained) continue;
      const double left = LeftByExchange(model, columns, a, own[i], b, own[j]);
      if (left >= 1) continue;
      DataFault f = FaultLeaving(r, a.name, "swap", left);
      f.with = b.name;
      f.mend = fmt::format("channels = {{ \"{}\" = \"{}\", \"{}\" = \"{}\" }}", a.name,
                           column(b.name), b.name, column(a.name));
      out.push_back(f);
      a.explained = b.explained = true;
    }
}

}  // namespace ambrig
