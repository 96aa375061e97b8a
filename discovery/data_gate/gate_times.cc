// Clocks: records and columns that come late, or that lost a block.
#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_shifts.h"

namespace ambrig {

namespace {

constexpr double kLeastShift = 5e-4;  // [s]: a smaller shift is a matter of the fit
constexpr double kLeastRows = 10;     // of a block that is lost
constexpr std::size_t kColumns = 5;   // that move most are looked at

/// Beside an effect a shift leaves much. It is believed where it is longer than anything in a rig
/// delays, where the movements say clearly that it is right, and where the prediction does not
/// repeat itself: the phase of a whirl is no clock.
bool IsClear(const std::vector<const GateColumn*>& moving, const FoundShift& s, double rate) {
  constexpr double kSurely = 4e-3;                                // [s]
  constexpr double kLeft = 0.7, kBefore = 0.5, kAfter = 0.75;     // of all rows [-]
  constexpr double kLeftFromThere = 0.5, kAfterFromThere = 0.85;  // an instant more to choose
  if (std::abs(s.late) < kSurely || s.left > (s.all_rows ? kLeft : kLeftFromThere)) return false;
  const auto rows = static_cast<long>(std::lround(s.late * rate));
  const long from = s.all_rows ? 0 : static_cast<long>(std::lround(s.from * rate));
  double before = 0, after = 0;
  for (const GateColumn* c : moving) {
    before += c->match.correlation / static_cast<double>(moving.size());
    after += MatchLater(c->column, rows, from).correlation / static_cast<double>(moving.size());
  }
  const bool clear = s.all_rows ? before < kBefore && after > kAfter : after > kAfterFromThere;
  return clear && !RepeatsItself(moving);
}

/// A clock that is wrong in all columns. Whether it is.
bool FindLateRecord(const CaseRecord& r, const std::vector<GateColumn>& columns,
                    std::vector<DataFault>& out) {
  const std::vector<const GateColumn*> moving = MovingColumns(columns, kColumns);
  if (!AnyGross(moving)) return false;
  const FoundShift s = ShiftOf(moving, r.data.rate);
  const double most = s.all_rows ? 0.4 : 0.3;  // an instant more to choose
  // what a fit may find is a shift of all rows
  const double least = s.all_rows ? kLeastShift : kLeastRows / r.data.rate;
  const bool believed =
      (std::abs(s.late) >= least && s.left < most) || IsClear(moving, s, r.data.rate);
  if (believed) out.push_back(TimeFault(r, "", s));
  return believed;
}

/// Rows that one column lost within the record. The machine may make a column run ahead from some
/// instant on, too, for example by a load that a rub carries in the magnet's place: a loss leaves
/// the noise, and moves no other column.
bool LosesRows(const std::vector<GateColumn>& columns, const GateColumn& c, const FoundShift& s) {
  constexpr double kLeft = 0.15, kFloors = 2, kOfOthers = 0.1;
  return s.late < 0 && s.left < kLeft && s.left * c.match.error < kFloors &&
         OthersOf(columns, c).error < kOfOthers * c.match.error;
}

constexpr double kErrsPlainly = 2,
                 kNothingLeft =
                     1.15;  // floors before a shift and after it, where the error is not gross

/// Whether a column may be late and nothing else: it errs plainly, all others of its bearing do
/// not. No effect delays what one column logs alone, so that its error need not be gross.
bool ErrsAlone(const std::vector<GateColumn>& columns, const GateColumn& c) {
  return c.match.error > kErrsPlainly && OthersOf(columns, c).error < kNothingLeft;
}

}  // namespace

void CheckTimes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  if (r.scenario.start == StartState::kResting) return;
  FindLateGroups(r, columns, out);
  if (FindLateRecord(r, columns, out)) {
    for (GateColumn& c : columns) c.explained = true;
    return;
  }
  std::vector<std::pair<GateColumn*, FoundShift>> late;
  for (GateColumn& c : columns) {
    if (c.explained || c.match.predicted_move < kMoves) continue;
    const bool gross =
        c.match.error >= kGrossError && c.match.error >= 0.1 * c.match.predicted_move;
    if (!gross && !ErrsAlone(columns, c)) continue;
    const FoundShift s = ShiftOf({&c}, r.data.rate);
    if (!gross && !(s.all_rows && s.left * c.match.error < kNothingLeft)) continue;
    const double least = IsOfKind(c.name, ChannelKind::kLoadCell) ? kLeastForce
                         : gross                                  ? kLeastColumn
                                                                  : kLeastShift;
    if (s.all_rows ? std::abs(s.late) >= least && s.left < 0.3 : LosesRows(columns, c, s))
      late.emplace_back(&c, s);
  }
  // a rig that is late is so in all its columns; a logger's own delay is in one or two, or in all
  // of a kind
  if (late.size() > 2) late.clear();
  for (const auto& [c, s] : late) {
    out.push_back(TimeFault(r, c->name, s));
    c->explained = true;
  }
}

}  // namespace ambrig
