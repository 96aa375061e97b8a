// Columns that were exchanged: each shows what the model expects of the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/record/channels.h"
#include "discovery/data/assignment.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

namespace {

// floors, of either column and of both together
constexpr double kLeastOfOne = 0.7 * kGrossError, kLeastOfBoth = 1.5 * kGrossError;
// floors of either column where the exchange leaves nothing but noise and the rest of the record
// shows no more
constexpr double kLeastOfPlain = 3, kNoiseAlone = 1.3;
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
  // The coil really carries what the column shows: its set-point asks for it, and the rest of its
  // bearing errs too. A force of the other sign makes opposite coils look exchanged. Or the
  // controller answered to this reading.
  bool carried;
  double others;  // error of the columns that a cause at this one would move [floors]
};

ExchangeSide ExchangeSideOf(const CaseModel& model, const std::vector<GateColumn>& columns,
                            GateColumn& c) {
  const double error = ErrorBesideZero(c, c.column.predicted, MostZero(model, c.name));
  const double others = OthersOf(columns, c).error;
  return {c, error,
          c.answered || (error >= kLeastOfOne && BorneOut(columns, c) &&
                         others > std::min(kAlone * error, kGrossError)),
          others};
}

/// Whether a third column of their kind that stands still errs by more than so many floors beside
/// its zero: the shaft is elsewhere, or bent, and two positions agree by chance.
bool OtherErrs(const std::vector<ExchangeSide>& all, const ExchangeSide& a, const ExchangeSide& b,
               double most) {
  return std::ranges::any_of(all, [&](const ExchangeSide& c) {
    return &c != &a && &c != &b && KindOf(c.column) == KindOf(a.column) && StandsStill(c.column) &&
           c.error > most;
  });
}

/// Whether two columns of one kind that move are exchanged as plainly as data can show it, however
/// near they are to each other: both err, each shows what is expected of the other, and nothing
/// else does.
bool IsPlainExchange(const ExchangeSide& a, const ExchangeSide& b, double left_of_a,
                     double left_of_b) {
  return KindOf(a.column) == KindOf(b.column) && !StandsStill(a.column) && !StandsStill(b.column) &&
         std::min(a.error, b.error) >= kLeastOfPlain &&
         std::max(left_of_a, left_of_b) <= kNoiseAlone &&
         std::max(a.others, b.others) <= kNoiseAlone;
}

/// The share of the error that an exchange of two of the columns leaves; 1 where it is not
/// believed.
double LeftByExchange(const CaseModel& model, const std::vector<ExchangeSide>& all,
                      const ExchangeSide& first, const ExchangeSide& second) {
  const GateColumn &a = first.column, &b = second.column;
  const double before = std::hypot(first.error, second.error);
  if (std::min(first.error, second.error) < kLeastOfPlain) return 1;
  if (first.carried && second.carried) return 1;
  const Exchanged a_as_b = Against(model, a, b), b_as_a = Against(model, b, a);
  const double left = std::hypot(a_as_b.error, b_as_a.error) / before;
  if (IsPlainExchange(first, second, a_as_b.error, b_as_a.error)) return left;
  if (std::min(first.error, second.error) < kLeastOfOne || before < kLeastOfBoth) return 1;
  const bool one_kind = KindOf(a) == KindOf(b);
  if (StandsStill(a) && StandsStill(b) &&
      (left > kLeftOfHeld || OtherErrs(all, first, second, kAlone * before)))
    return 1;
  const bool clear = one_kind && std::max(a.match.correlation, b.match.correlation) < kOfItself &&
                     std::min(a_as_b.correlation, b_as_a.correlation) > kOfOther;
  const double most = clear ? kLeftBesideEffect : one_kind ? kLeftOfKind : kLeftOfOthers;
  return left > most ? 1 : left;
}

std::string FileColumn(const CaseRecord& r, const std::string& channel) {
  const auto it = r.sources.find(channel);
  return it == r.sources.end() ? channel : it->second.column;
}

/// Cycles of three and more of a permutation.
std::vector<std::vector<std::size_t>> LongCycles(const std::vector<std::size_t>& next) {
  std::vector<std::vector<std::size_t>> out;
  std::vector<char> seen(next.size(), 0);
  for (std::size_t first = 0; first < next.size(); ++first) {
    std::vector<std::size_t> cycle;
    for (std::size_t k = first; !seen[k]; k = next[k]) seen[k] = 1, cycle.push_back(k);
    if (cycle.size() > 2) out.push_back(cycle);
  }
  return out;
}

/// The share of the error that is left if each column of the cycle shows what the model expects of
/// the next one; 1 where it is not believed: each has to gain, and none may be a coil that really
/// carries what it shows.
double LeftByCycle(const std::vector<const ExchangeSide*>& sides, const Eigen::MatrixXd& error,
                   const std::vector<std::size_t>& cycle) {
  constexpr double kOfEach = 0.6;
  double before = 0, after = 0;
  bool still = false;
  for (std::size_t n = 0; n < cycle.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(cycle[n]),
               column = static_cast<Eigen::Index>(cycle[(n + 1) % cycle.size()]);
    if (sides[cycle[n]]->carried || error(row, column) > kOfEach * error(row, row)) return 1;
    still = still || StandsStill(sides[cycle[n]]->column);
    before += std::pow(error(row, row), 2);
    after += std::pow(error(row, column), 2);
  }
  const double left = std::sqrt(after / before);
  return left < (still ? kLeftOfHeld : kLeftOfKind) ? left : 1;
}

/// Three columns of a kind and more that were passed on round a circle: the assignment of all that
/// err to what the model expects of all, of which pairs are left to the look at pairs.
void FindCycles(const CaseModel& model, const CaseRecord& r, const std::vector<ExchangeSide>& all,
                std::vector<DataFault>& out) {
  std::map<std::pair<ChannelKind, bool>, std::vector<const ExchangeSide*>> by_kind;
  for (const ExchangeSide& side : all)
    if (!side.column.explained && side.error >= kLeastOfOne)
      by_kind[KindOf(side.column)].push_back(&side);
  for (const auto& [kind, sides] : by_kind) {
    const auto n = static_cast<Eigen::Index>(sides.size());
    if (n < 3) continue;
    Eigen::MatrixXd error(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b < n; ++b)
        error(a, b) = Against(model, sides[static_cast<std::size_t>(a)]->column,
                              sides[static_cast<std::size_t>(b)]->column)
                          .error;
    for (const auto& cycle : LongCycles(LeastAssignment(error.cwiseAbs2()))) {
      const double left = LeftByCycle(sides, error, cycle);
      if (left >= 1) continue;
      for (std::size_t k = 0; k < cycle.size(); ++k) {
        GateColumn& c = sides[cycle[k]]->column;
        DataFault f = FaultLeaving(r, c.name, "swap", left);
        f.with = sides[cycle[(k + 1) % cycle.size()]]->column.name;
        f.mend = fmt::format("channels.\"{}\" = \"{}\"", f.with, FileColumn(r, c.name));
        out.push_back(f);
        c.explained = true;
      }
    }
  }
}

}  // namespace

void CheckSwaps(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  std::vector<ExchangeSide> all;
  for (GateColumn& c : columns) all.push_back(ExchangeSideOf(model, columns, c));
  FindCycles(model, r, all, out);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      GateColumn &a = all[i].column, &b = all[j].column;
      if (a.explained || b.explained) continue;
      const double left = LeftByExchange(model, all, all[i], all[j]);
      if (left >= 1) continue;
      DataFault f = FaultLeaving(r, a.name, "swap", left);
      f.with = b.name;
      f.mend = fmt::format("channels = {{ \"{}\" = \"{}\", \"{}\" = \"{}\" }}", a.name,
                           FileColumn(r, b.name), b.name, FileColumn(r, a.name));
      out.push_back(f);
      a.explained = b.explained = true;
    }
}

}  // namespace ambrig
