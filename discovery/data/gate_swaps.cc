// Columns that were exchanged: each shows what the model expects of the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/gate_columns.h"

namespace ambrig {

namespace {

// floors, of either column and of both together
constexpr double kLeastOfOne = 0.7 * kGrossError, kLeastOfBoth = 1.5 * kGrossError;
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

/// What of a column does not depend on the other one of a pair.
struct ExchangeSide {
  GateColumn& column;
  double error;  // beside a zero, as it stands [floors]
  // The coil really carries what the column shows: its set-point asks for it, and the rest of its bearing errs too. A
  // force of the other sign makes opposite coils look exchanged.
  bool carried;
};

ExchangeSide ExchangeSideOf(const CaseModel& model, const std::vector<GateColumn>& columns,
                            GateColumn& c) {
  const double error = ErrorBesideZero(c, c.column.predicted, MostZero(model, c.name));
  return {c, error,
          error >= kLeastOfOne && BorneOut(columns, c) &&
              OthersOf(columns, c).error > std::min(kAlone * error, kGrossError)};
}

/// Whether a third column of their kind that stands still errs by more than so many floors beside its zero: the shaft is
/// elsewhere, or bent, and two positions agree by chance.
bool OtherErrs(const std::vector<ExchangeSide>& all, const ExchangeSide& a, const ExchangeSide& b,
               double most) {
  return std::ranges::any_of(all, [&](const ExchangeSide& c) {
    return &c != &a && &c != &b && KindOf(c.column) == KindOf(a.column) && StandsStill(c.column) &&
           c.error > most;
  });
}

/// The share of the error that an exchange of two of the columns leaves; 1 where it is not believed.
double LeftByExchange(const CaseModel& model, const std::vector<ExchangeSide>& all,
                      const ExchangeSide& first, const ExchangeSide& second) {
  const GateColumn &a = first.column, &b = second.column;
  const double before = std::hypot(first.error, second.error);
  if (std::min(first.error, second.error) < kLeastOfOne || before < kLeastOfBoth) return 1;
  if (first.carried && second.carried) return 1;
  const Exchanged a_as_b = Against(model, a, b), b_as_a = Against(model, b, a);
  const double left = std::hypot(a_as_b.error, b_as_a.error) / before;
  const bool one_kind = KindOf(a) == KindOf(b);
  if (StandsStill(a) && StandsStill(b) &&
      (left > kLeftOfHeld || OtherErrs(all, first, second, kAlone * before)))
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
  std::vector<ExchangeSide> all;
  for (GateColumn& c : columns) all.push_back(ExchangeSideOf(model, columns, c));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      GateColumn &a = all[i].column, &b = all[j].column;
      if (a.explained || b.explained) continue;
      const double left = LeftByExchange(model, all, all[i], all[j]);
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
