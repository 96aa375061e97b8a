// Columns that are late together: of one instrument, one converter, one bearing's electronics.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/record/channels.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_shifts.h"

namespace ambrig {

namespace {

constexpr double kOfInstrument = 0.75, kOfConverter = 0.3;

struct LateGroup {
  std::function<bool(const ChannelId&)> holds;
  // Share of the error that the shift may leave. All readings or all currents of a rig have one
  // instrument often, and nothing in a rig delays them alone; iron delays forces a little, a
  // sensor's filter the readings of its bearing.
  double most_left;
};

/// From the largest to the smallest, so that what a smaller one would tell of its columns is told
/// of all.
std::vector<LateGroup> LateGroupsOf(const std::vector<GateColumn>& columns) {
  constexpr ChannelKind kKinds[] = {ChannelKind::kReading, ChannelKind::kCoilCurrent,
                                    ChannelKind::kLoadCell, ChannelKind::kSetPoint,
                                    ChannelKind::kDuty};
  std::vector<LateGroup> out;
  for (const ChannelKind kind : kKinds) {
    const bool instrument = kind == ChannelKind::kReading || kind == ChannelKind::kCoilCurrent;
    out.push_back({[kind](const ChannelId& id) { return id.kind == kind; },
                   instrument ? kOfInstrument : kOfConverter});
  }
  std::set<std::string> planes;
  for (const GateColumn& c : columns)
    if (const auto id = ParseChannel(c.name); id && !id->plane.empty()) planes.insert(id->plane);
  for (const std::string& plane : planes)
    out.push_back({[plane](const ChannelId& id) { return id.plane == plane; }, kOfConverter});
  for (const std::string& plane : planes)
    for (const ChannelKind kind : kKinds)
      out.push_back(
          {[plane, kind](const ChannelId& id) { return id.plane == plane && id.kind == kind; },
           kOfConverter});
  return out;
}

/// rms of the errors over the movements.
double ErrorOfMovement(const std::vector<const GateColumn*>& columns) {
  double sum = 0;
  for (const GateColumn* c : columns) sum += std::pow(c->match.error / c->match.predicted_move, 2);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, columns.size())));
}

/// The columns of the group are late and those beside it are on time, each of them by itself where
/// it can tell.
bool IsLate(const std::vector<const GateColumn*>& own, const std::vector<const GateColumn*>& others,
            const FoundShift& s, double most_left, double rate) {
  constexpr double kLeast = 2e-3;  // [s]
  const bool forces = IsOfKind(own[0]->name, ChannelKind::kLoadCell);
  if (std::abs(s.late) < (forces ? kLeastForce : kLeast) || s.left > most_left || !s.all_rows)
    return false;
  const bool one_on_time =
      std::ranges::any_of(own, [&](const GateColumn* c) { return AreOnTime({c}, s.late, rate); });
  return !one_on_time && AreOnTime(others, s.late, rate) && !RepeatsItself(own);
}

}  // namespace

void FindLateGroups(const CaseRecord& r, std::vector<GateColumn>& columns,
                    std::vector<DataFault>& out) {
  for (const LateGroup& group : LateGroupsOf(columns)) {
    const auto holds = [&](const GateColumn& c) {
      const auto id = ParseChannel(c.name);
      return id && group.holds(*id);
    };
    std::vector<const GateColumn*> own, others;
    for (const GateColumn* c : MovingColumns(columns, columns.size()))
      (holds(*c) ? own : others).push_back(c);
    if (own.size() < 2 || others.empty() || !AnyGross(own)) continue;
    // what the rig does itself shows in the others, too
    if (group.most_left <= kOfConverter && ErrorOfMovement(others) > 0.5 * ErrorOfMovement(own))
      continue;
    const FoundShift s = ShiftOf(own, r.data.rate);
    if (!IsLate(own, others, s, group.most_left, r.data.rate)) continue;
    for (GateColumn& c : columns) {
      if (c.explained || !holds(c)) continue;
      out.push_back(TimeFault(r, c.name, s));
      c.explained = true;
    }
  }
}

}  // namespace ambrig
