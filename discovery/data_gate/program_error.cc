#include "discovery/data_gate/program_error.h"

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/clock_shift.h"
#include "discovery/data_gate/data_gate.h"
#include "discovery/model/record_traits.h"

namespace ambrig {

namespace {

constexpr double kCurrentFloor = 1e-4;  // [A], of a control current
constexpr double kOfMovement = 0.03;    // of the command's movement: rounding of the record

bool DrivesController(const std::string& channel) {
  return IsOfKind(channel, ChannelKind::kReading) || IsOfKind(channel, ChannelKind::kSetPoint);
}

/// rms of the error [A] without its largest values: single wrong samples, edges of steps.
double LastingError(const ControllerAxis& a) {
  constexpr double kLargest = 0.02;  // of the rows
  std::vector<double> squares;
  for (std::size_t k = 0; k < a.error.size(); ++k)
    if (a.counts[k]) squares.push_back(a.error[k] * a.error[k]);
  std::ranges::sort(squares);
  squares.resize(squares.size() -
                 static_cast<std::size_t>(kLargest * static_cast<double>(squares.size())));
  double sum = 0;
  for (const double square : squares) sum += square;
  return squares.empty() ? 0 : std::sqrt(sum / static_cast<double>(squares.size()));
}

}  // namespace

BridgedRecord ControllerRecord(const Record& data) {
  return BridgeMissing(data, kLoopsSettle, DrivesController);
}

bool IsWrong(const ControllerAxis& a) {
  const double error = LastingError(a);
  return error > kGrossError * kCurrentFloor && error > kOfMovement * a.movement;
}

bool ShowsProgram(const ControllerAxis& a) { return a.movement > 2 * kGrossError * kCurrentFloor; }

std::vector<std::string> AnsweredReadings(const CaseModel& model, std::size_t record) {
  std::vector<std::string> out;
  const CaseRecord& r = model.data().records[record];
  if (!OverTime(r) || !HasControllerBlock(model.data().rig, r.scenario, r.data)) return out;
  for (const ControllerAxis& a :
       ControllerAxes(model.data().rig, r.scenario, ControllerRecord(r.data)))
    if (ShowsProgram(a) && !IsWrong(a)) out.push_back(a.axis);
  return out;
}

bool ProgramIsRight(const CaseModel& model) {
  for (std::size_t r = 0; r < model.data().records.size(); ++r)
    if (!AnsweredReadings(model, r).empty()) return true;
  return false;
}

}  // namespace ambrig
