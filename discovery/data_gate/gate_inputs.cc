// Inputs that acted otherwise than the scenario of their record states: loads with another
// direction or at other instants, commands of another size.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/record/channels.h"
#include "discovery/data_gate/command_sizes.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/input_answers.h"

namespace ambrig {

namespace {

constexpr double kOfThisRecord = 0.3;  // error over movement that the other records may show
constexpr double kPlainError = 3, kOfNoise = 1.15;  // floors: of a reading, of what is left
constexpr double kOtherInputsLeave = 0.15;          // of the error (rms), at most
constexpr double kLongestMove = 0.05;               // [s] of an edge of a load
constexpr double kCoarseMove = 1e-3;                // [s]
constexpr double kLeastMove = 2e-3;                 // [s]: less is a matter of the clock
constexpr double kTurned = 0.87;  // cosine of the angle from which on a direction is another
constexpr int kSweeps = 3;

bool IsPosition(const GateColumn& c) { return IsOfKind(c.name, ChannelKind::kReading); }

/// Error of the readings above their noise over their movement, rms; -1: there are none that
/// move.
double ReadingsError(const std::vector<GateColumn>& columns) {
  double sum = 0, n = 0;
  for (const GateColumn& c : columns)
    if (IsPosition(c) && c.match.predicted_move > kMoves)
      sum += std::max(0.0, std::pow(c.match.error, 2) - kOfNoise * kOfNoise) /
             std::pow(c.match.predicted_move, 2),
          n += 1;
  return n > 0 ? std::sqrt(sum / n) : -1;
}

/// Forces and edges, one edge after the other.
double Seek(InputAnswers& inputs, std::vector<ActingLoad>& loads) {
  double least = inputs.Fit(loads);
  const auto try_edge = [&](std::size_t l, double ActingLoad::*edge, double to) {
    std::vector<ActingLoad> tried = loads;
    tried[l].*edge = to;
    if (!(tried[l].start < tried[l].stop)) return;
    if (const double left = inputs.Fit(tried); left < least) least = left, loads = tried;
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t l = 0; l < loads.size(); ++l)
      for (double ActingLoad::*edge : {&ActingLoad::start, &ActingLoad::stop}) {
        const double stated = inputs.stated()[l].*edge;
        for (double move = -kLongestMove; move <= kLongestMove; move += kCoarseMove)
          try_edge(l, edge, stated + move);
        const double middle = loads[l].*edge;
        for (double move = -kCoarseMove; move <= kCoarseMove; move += inputs.step())
          try_edge(l, edge, middle + move);
      }
  return inputs.Fit(loads);
}

/// Whether a load is another one than stated. A force of the same direction and time is not: what
/// the rig lacks of stiffness, or carries beside its magnets, looks like that.
bool ActsOtherwise(const ActingLoad& stated, const ActingLoad& acting) {
  const double cosine = (stated.fx * acting.fx + stated.fy * acting.fy) /
                        (std::hypot(stated.fx, stated.fy) * std::hypot(acting.fx, acting.fy));
  return cosine < kTurned || std::abs(acting.start - stated.start) > kLeastMove ||
         std::abs(acting.stop - stated.stop) > kLeastMove;
}

/// Whether commands had another size, not all of them the same: that a fit of the record's input
/// finds, and a rig of another gain shows.
bool CommandedOtherwise(const std::vector<double>& sizes) {
  constexpr double kOtherSize = 0.25;
  if (sizes.empty()) return false;
  const auto [least, most] = std::ranges::minmax(sizes);
  return most - least > kOtherSize;
}

std::string LoadsText(const std::vector<ActingLoad>& loads) {
  std::string out;
  for (std::size_t l = 0; l < loads.size(); ++l)
    out += fmt::format("{}force = [{:.3g}, {:.3g}], start = {:.4g}, stop = {:.4g}",
                       l == 0 ? "its loads were rather " : "; ", loads[l].fx, loads[l].fy,
                       loads[l].start, loads[l].stop);
  return out;
}

/// Whether the inputs of a record can be told from its readings.
bool HasInputs(const CaseRecord& r) {
  return OverTime(r) && r.scenario.start == StartState::kLevitated &&
         !(r.scenario.loads.empty() && r.scenario.excitations.empty()) &&
         r.scenario.faults.empty() && r.imposed == Imposed::kNothing &&
         std::ranges::all_of(r.scenario.loads, [](const LoadSpec& l) {
           return !l.axial && std::hypot(l.fx, l.fy) > 0;
         });
}

void InspectRecordInputs(const SimulatedReadings& readings, const CaseRecord& record,
                         std::vector<DataFault>& out) {
  InputAnswers inputs(readings);
  std::vector<ActingLoad> loads = inputs.stated();
  const double left = Seek(inputs, loads);
  bool otherwise = CommandedOtherwise(inputs.sizes());
  for (std::size_t l = 0; l < loads.size(); ++l)
    otherwise = otherwise || ActsOtherwise(inputs.stated()[l], loads[l]);
  if (!(left < std::max(kOtherInputsLeave * inputs.before(), kOfNoise)) || !otherwise) return;
  DataFault f = FaultLeaving(record, "", "scenario", left / inputs.before());
  f.detail = LoadsText(loads);
  if (const std::string sizes = CommandSizesText(record.scenario, inputs.sizes()); !sizes.empty())
    f.detail += (f.detail.empty() ? "" : "; ") + sizes;
  TellScenario(f, out);
}

}  // namespace

void CheckInputs(const CaseModel& model, const std::vector<double>& predicted, const Hypothesis& h,
                 std::vector<DataFault>& out) {
  const std::size_t records = model.data().records.size();
  if (std::ranges::none_of(model.data().records, HasInputs)) return;
  std::vector<std::vector<GateColumn>> columns(records);
  std::vector<double> errors;
  for (std::size_t r = 0; r < records; ++r) {
    if (OverTime(model.data().records[r])) columns[r] = ColumnsOf(model, predicted, r);
    errors.push_back(ReadingsError(columns[r]));
  }
  for (std::size_t r = 0; r < columns.size(); ++r) {
    const CaseRecord& record = model.data().records[r];
    const bool gross = std::ranges::any_of(columns[r], [](const GateColumn& c) {
      return IsPosition(c) && c.match.error > kPlainError;
    });
    double others = -1;
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (k != r) others = std::max(others, errors[k]);
    if (!HasInputs(record) || !gross || others < 0 || others > kOfThisRecord * errors[r]) continue;
    try {
      InspectRecordInputs(SimulatedReadings(model, h, r, columns[r]), record, out);
    } catch (const std::runtime_error&) {
      continue;  // the model loses its rotor under another input
    }
  }
}

}  // namespace ambrig
