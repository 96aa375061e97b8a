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

bool ProgramIsRight(const CaseModel& model) {
  return std::ranges::any_of(model.data().records, [&](const CaseRecord& r) {
    if (!OverTime(r) || !HasControllerBlock(model.data().rig, r.scenario, r.data)) return false;
    const auto axes = ControllerAxes(model.data().rig, r.scenario, ControllerRecord(r.data));
    return std::ranges::any_of(
        axes, [](const ControllerAxis& a) { return ShowsProgram(a) && !IsWrong(a); });
  });
}

}  // namespace ambrig
