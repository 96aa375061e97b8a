// The controller's own program as a witness of its record: what no effect of the rig can change.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/record/channels.h"
#include "discovery/data/clock_shift.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/command_replay.h"
#include "discovery/data_gate/command_sizes.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_shifts.h"
#include "discovery/data_gate/lost_rows.h"
#include "discovery/data_gate/program_error.h"
#include "discovery/model/controller_block.h"
#include "discovery/model/record_traits.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kUndone = 0.1;            // of the error that the right hypothesis may leave
constexpr double kOfInputNuisances = 0.3;  // of it that a clock and an input's size may leave
constexpr double kMostInputGain = 1.6;     // that the fits give an input, or its inverse
constexpr double kLongestLag = 0.05;       // [s]
constexpr std::size_t kMostBlocks = 4;     // of lost rows in one record

/// The size and the clock of the commands that leave the least error.
struct InputFit {
  double gain = 1;  // of what the scenario commands [-]
  double late = 0;  // [rows]
  double left = 1;  // share of the error that remains
};

/// The error with commands `late` rows later that have the best size: it is linear in the size.
class InputTrial {
 public:
  InputTrial(const RigParameters& rig, const Scenario& scenario, const BridgedRecord& data,
             const CommandReplay& replay)
      : rig_(rig),
        scenario_(scenario),
        data_(data),
        silent_(replay.silent),
        now_(replay.now),
        without_(CountedErrors(silent_)),
        before_(CountedErrors(now_).norm()) {}
  /// As Late, of whole rows, by the answer as it is at 0: nothing in the controller depends on
  /// time.
  InputFit Shifted(long rows) const {
    double cross = 0, square = 0, before = 0;
    for (std::size_t a = 0; a < silent_.size(); ++a) {
      const auto n = static_cast<long>(silent_[a].error.size());
      for (long k = std::max(0L, rows); k < std::min(n, n + rows); ++k) {
        const auto at = static_cast<std::size_t>(k), of = static_cast<std::size_t>(k - rows);
        if (!silent_[a].counts[at]) continue;
        const double answer = now_[a].error[of] - silent_[a].error[of];
        cross += answer * silent_[a].error[at];
        square += answer * answer;
        before += silent_[a].error[at] * silent_[a].error[at];
      }
    }
    if (square <= 0) return {1, static_cast<double>(rows), kInfinity};
    const double left = std::max(0.0, before - cross * cross / square);
    return {-cross / square, static_cast<double>(rows), std::sqrt(left) / before_};
  }
  InputFit Late(double rows) const {
    const Eigen::VectorXd answer = AnswerTo(rows);
    const double square = answer.squaredNorm();
    const double gain = square > 0 ? -answer.dot(without_) / square : 1;
    return {gain, rows, (without_ + gain * answer).norm() / before_};
  }

 private:
  Eigen::VectorXd AnswerTo(double late) const {
    return CountedErrors(ControllerAxes(rig_, scenario_, data_, late)) - without_;
  }
  const RigParameters& rig_;
  const Scenario& scenario_;
  const BridgedRecord& data_;
  const std::vector<ControllerAxis>&silent_, &now_;  // without commands, with them
  Eigen::VectorXd without_;
  double before_;
};

/// Whole rows, then parts of a row: steps on rows and between them move at other instants.
InputFit FitInput(const RigParameters& rig, const Scenario& scenario, const BridgedRecord& data,
                  const CommandReplay& replay) {
  const InputTrial trial(rig, scenario, data, replay);
  const long most = MostRowsOff(data.record.rate);
  InputFit best;
  const auto try_late = [&](double rows) {
    const InputFit fit = trial.Late(rows);
    if (fit.left < best.left) best = fit;
  };
  for (long late = -most; late <= most; ++late) try_late(static_cast<double>(late));
  const long longest = std::lround(kLongestLag * data.record.rate);
  InputFit far = best;
  for (long late = -longest; late <= longest; ++late)
    if (const InputFit fit = trial.Shifted(late); fit.left < far.left) far = fit;
  if (std::abs(far.late) > static_cast<double>(most) && far.left < kOfInputNuisances * best.left)
    best = trial.Late(far.late);
  for (const double step : {0.5, 0.25, 0.125}) {
    const double middle = best.late;
    try_late(middle - step);
    try_late(middle + step);
  }
  return best;
}

/// The axis alone, with `y` for its reading.
ControllerAxis AxisWith(const RigParameters& rig, const Scenario& scenario, BridgedRecord& data,
                        const std::string& axis, const std::vector<double>& y) {
  for (Channel& c : data.record.channels)
    if (c.name == axis) c.samples = y;
  for (ControllerAxis& a : ControllerAxes(rig, scenario, data))
    if (a.axis == axis) return std::move(a);
  return {};
}

/// The record with the channels of the bearing of an axis alone.
BridgedRecord BearingOf(const BridgedRecord& data, const std::string& axis) {
  BridgedRecord out = data;
  const auto own = ParseChannel(axis);
  std::erase_if(out.record.channels, [&](const Channel& c) {
    const auto id = ParseChannel(c.name);
    return !id || !own || id->plane != own->plane;
  });
  return out;
}

/// What the reading of an axis is of what it should be; 1: no factor brings its set-points back.
/// The error is linear in it.
double FactorOfReading(const RigParameters& rig, const Scenario& scenario,
                       const BridgedRecord& data, const ControllerAxis& axis) {
  BridgedRecord bearing = BearingOf(data, axis.axis);
  const std::vector<double> none(data.record.rows(), 0.0);
  const ControllerAxis without = AxisWith(rig, scenario, bearing, axis.axis, none);
  double cross = 0, square = 0, before = 0, total = 0;
  for (std::size_t k = 0; k < axis.error.size(); ++k) {
    if (!axis.counts[k]) continue;
    const double answer = axis.error[k] - without.error[k];
    cross += answer * without.error[k];
    square += answer * answer;
    before += without.error[k] * without.error[k];
    total += axis.error[k] * axis.error[k];
  }
  if (square <= 0 || cross == 0) return 1;
  const double left = std::max(0.0, before - cross * cross / square);
  return left < kUndone * kUndone * total ? -square / cross : 1;
}

/// Rows by which the reading of an axis is late; 0: no lag brings its set-points back.
long LagOfReading(const RigParameters& rig, const Scenario& scenario, const BridgedRecord& data,
                  const ControllerAxis& axis) {
  const std::vector<double>& y = data.record.Find(axis.axis)->samples;
  const auto rows = static_cast<long>(y.size());
  const long most = std::min(rows / 4, std::lround(kLongestLag * data.record.rate));
  BridgedRecord bearing = BearingOf(data, axis.axis);
  std::vector<double> moved(y.size());
  long best = 0;
  double least = kUndone * axis.rms;
  for (long late = -most; late <= most; ++late) {
    for (long k = 0; k < rows; ++k)
      moved[static_cast<std::size_t>(k)] =
          y[static_cast<std::size_t>(std::clamp(k + late, 0L, rows - 1))];
    const double left = AxisWith(rig, scenario, bearing, axis.axis, moved).rms;
    if (left < least) least = left, best = late;
  }
  return best;
}

/// Whether the error enters as a command does: a wrong reading would carry the noise of its sensor
/// into it.
bool IsCommand(const BridgedRecord& data, const ControllerAxis& a) {
  constexpr double kOfNoise = 0.1;
  const std::vector<double>& y = data.record.Find(a.axis)->samples;
  const double noise = WhiteNoiseOf(y.data(), a.counts.data(), a.counts.size());
  return WhiteNoiseOf(a.reference.data(), a.counts.data(), a.counts.size()) < kOfNoise * noise;
}

/// "A.x was commanded up to 32.5 um (1.6 N) otherwise, first at 0.026 s".
std::string CommandText(const RigParameters& rig, const Record& data, const ControllerAxis& a) {
  constexpr double kOfLargest = 0.1;
  double largest = 0;
  for (std::size_t k = 0; k < a.reference.size(); ++k)
    if (a.counts[k]) largest = std::max(largest, std::abs(a.reference[k]));
  std::size_t first = 0;
  while (!a.counts[first] || std::abs(a.reference[first]) < kOfLargest * largest) ++first;
  double kp = 0;
  for (const BearingParameters& b : rig.bearings)
    if (std::ranges::count(b.Axes(), a.axis)) kp = PidOf(rig, b).kp;
  return fmt::format(
      "the controller was commanded otherwise at {}, by up to {:.3g} um or {:.3g} N, "
      "first at {:.4g} s",
      a.axis, 1e6 * largest, std::abs(kp) * largest, data.TimeAt(first));
}

/// Commands that were late by more, or of another size, than the fits allow for each record.
void TellInput(const CaseRecord& r, const InputFit& fit, std::vector<DataFault>& out) {
  if (std::abs(std::log(std::max(fit.gain, 1e-9))) > std::log(kMostInputGain)) {
    DataFault f = FaultLeaving(r, "", "scenario", fit.left);
    f.detail = fmt::format("its commands were {:.4g} times what the scenario says", fit.gain);
    TellScenario(f, out);
  } else if (std::abs(fit.late) > static_cast<double>(kMostRowsOff)) {
    out.push_back(TimeFault(r, "", {fit.late / r.data.rate, 0, fit.left, true}));
  }
}

/// The first block of rows that were lost, with the others in its detail.
void TellLostBlocks(const CaseRecord& r, const LostBlocks& lost, std::vector<DataFault>& out) {
  const auto seconds = [&](std::size_t rows) { return static_cast<double>(rows) / r.data.rate; };
  const LostBlock& first = lost.blocks[0];
  out.push_back(TimeFault(r, "", {-seconds(first.rows), seconds(first.row), lost.left, false}));
  DataFault& f = out.back();
  f.detail = fmt::format("{} rows at {:.4g} s", first.rows, r.data.TimeAt(first.row));
  for (std::size_t k = 1; k < lost.blocks.size(); ++k)
    f.detail += fmt::format(", {} rows at {:.4g} s", lost.blocks[k].rows,
                            r.data.TimeAt(lost.blocks[k].row));
}

/// The clock of a record that was found late by its columns, as late as its commands are for the
/// controller's program: a wrong parameter of the rig moves the best match of the columns.
void RefineClock(const CaseModel& model, const CaseRecord& r, DataFault& clock) {
  const RigParameters& rig = model.data().rig;
  const BridgedRecord data = ControllerRecord(r.data);
  const CommandReplay replay =
      ReplayCommands(rig, r.scenario, data, ControllerAxes(rig, r.scenario, data));
  const InputFit fit = FitInput(rig, r.scenario, data, replay);
  if (fit.left > kUndone) return;
  const double probability = clock.probability;
  clock = TimeFault(r, "", {fit.late / r.data.rate, 0, fit.left, true});
  clock.probability = std::max(probability, clock.probability);
}

}  // namespace

void CheckController(const CaseModel& model, std::size_t record,
                     const std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const RigParameters& rig = model.data().rig;
  if (r.imposed != Imposed::kNothing || !r.scenario.faults.empty() ||
      !HasControllerBlock(rig, r.scenario, r.data))
    return;
  const auto clock = std::ranges::find_if(
      out, [](const DataFault& f) { return f.fault == "lag" && f.channel.empty(); });
  if (clock != out.end()) RefineClock(model, r, *clock);
  if (!out.empty() || std::ranges::any_of(columns, &GateColumn::explained)) return;
  const BridgedRecord data = ControllerRecord(r.data);
  std::vector<ControllerAxis> axes = ControllerAxes(rig, r.scenario, data);
  if (std::ranges::none_of(axes, IsWrong) || !ProgramIsRight(model)) return;
  const CommandReplay replay = ReplayCommands(rig, r.scenario, data, std::move(axes));
  std::vector<const ControllerAxis*> wrong;
  for (const ControllerAxis& a : replay.now)
    if (IsWrong(a)) wrong.push_back(&a);
  if (const InputFit fit = FitInput(rig, r.scenario, data, replay); fit.left < kOfInputNuisances) {
    TellInput(r, fit, out);
    return;
  }
  const CommandSizes sizes = FindCommandSizes(rig, r.scenario, data, replay);
  if (const std::string text = CommandSizesText(r.scenario, sizes.of_excitations);
      sizes.left < kUndone && !text.empty()) {
    DataFault f = FaultLeaving(r, "", "scenario", sizes.left);
    f.detail = text;
    TellScenario(f, out);
    return;
  }
  const LostBlocks lost = FindLostBlocks(replay, data.record.rate);
  if (lost.left < kOfInputNuisances && !lost.blocks.empty() && lost.blocks.size() <= kMostBlocks) {
    TellLostBlocks(r, lost, out);
    return;
  }
  const auto worst = *std::ranges::max_element(wrong, {}, [](auto* a) { return a->rms; });
  if (std::ranges::all_of(wrong, [&](const auto* a) { return IsCommand(data, *a); })) {
    DataFault f = FaultLeaving(r, "", "scenario", kUndone);
    f.detail = CommandText(rig, r.data, *worst);
    TellScenario(f, out);
    return;
  }
  for (const ControllerAxis* a : wrong)
    if (const double factor = FactorOfReading(rig, r.scenario, data, *a); factor != 1)
      out.push_back(FactorFault(r, a->axis, factor, kUndone));
    else if (const long late = LagOfReading(rig, r.scenario, data, *a); late != 0)
      out.push_back(
          TimeFault(r, a->axis, {static_cast<double>(late) / data.record.rate, 0, kUndone, true}));
}

}  // namespace ambrig
