// Inputs that acted otherwise than the scenario of their record states: loads with another
// direction or at other instants, commands of another size.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/linear_equations.h"
#include "core/record/channels.h"
#include "discovery/data_gate/command_sizes.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/program_error.h"
#include "discovery/model/record_rows.h"

namespace ambrig {

namespace {

constexpr double kOfThisRecord = 0.3;  // error over movement that the other records may show
constexpr double kPlainError = 3, kOfNoise = 1.15;  // floors: of a reading, of what is left
constexpr double kMoreOfCommand = 0.1;              // by which a command is changed
constexpr double kOtherInputsLeave = 0.15;          // of the error (rms), at most
constexpr double kLongestMove = 0.05;               // [s] of an edge of a load
constexpr double kCoarseMove = 1e-3;                // [s]
constexpr double kLeastMove = 2e-3;                 // [s]: less is a matter of the clock
constexpr double kTurned = 0.87;  // cosine of the angle from which on a direction is another
constexpr double kRidge = 1e-12;
constexpr int kSweeps = 3;
constexpr std::size_t kMostRows = 2000;  // of a search: longer records are thinned

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

/// Force and edges of a load [N], [s].
struct ActingLoad {
  double fx = 0, fy = 0, start = 0, stop = 0;
};

/// The readings of a record, thinned, and how they answer to the loads and the commands of its
/// scenario. All values in floors; the readings stand one behind the other.
class InputTrials {
 public:
  InputTrials(const CaseModel& model, const Hypothesis& h, std::size_t record,
              const std::vector<GateColumn>& columns);

  const std::vector<ActingLoad>& stated() const { return stated_; }
  double step() const { return step_; }
  /// rms of the error [floors].
  double before() const { return Rms(error_.squaredNorm()); }
  /// Sizes of the commands beside the last loads that were fitted [-].
  const std::vector<double>& sizes() const { return sizes_; }
  /// The forces with these edges, and the sizes of the commands, that leave the least error: its
  /// rms [floors].
  double Fit(std::vector<ActingLoad>& loads);

 private:
  Eigen::VectorXd Answer(const Eigen::VectorXd& step_answer, const ActingLoad& stated,
                         const ActingLoad& acting) const;
  double Rms(double square) const {
    return std::sqrt(std::max(0.0, square) / static_cast<double>(error_.size()));
  }
  Eigen::Index rows_ = 0, readings_ = 0;
  double step_ = 0;                // [s] between rows
  Eigen::VectorXd error_, moved_;  // measured less predicted, without and with the stated loads
  std::vector<ActingLoad> stated_;
  // of each load along x and y: to a step of 1 N that begins with the load and stays
  std::vector<Eigen::VectorXd> steps_;
  std::vector<Eigen::VectorXd> commands_;  // to each excitation once more; empty: not sought
  std::vector<double> sizes_;
};

InputTrials::InputTrials(const CaseModel& model, const Hypothesis& h, std::size_t record,
                         const std::vector<GateColumn>& columns) {
  Case alone = model.data();
  alone.records = {model.data().records[record]};
  const CaseRecord& r = alone.records[0];
  const std::size_t thin = std::max<std::size_t>(1, r.data.rows() / kMostRows);
  rows_ = static_cast<Eigen::Index>(r.data.rows() / thin);
  step_ = static_cast<double>(thin) / r.data.rate;
  std::vector<const GateColumn*> readings;
  for (const GateColumn& c : columns)
    if (IsPosition(c)) readings.push_back(&c);
  readings_ = static_cast<Eigen::Index>(readings.size());
  std::vector<std::string> names;
  for (const GateColumn* c : readings) names.push_back(c->name);
  const auto simulated = [&](const Scenario& scenario) {
    Case changed = alone;
    changed.records[0].scenario = scenario;
    const Record run = CaseModel(std::move(changed)).Simulated(h, 0, false, 1, names);
    Eigen::VectorXd out(rows_ * readings_);
    for (Eigen::Index c = 0; c < readings_; ++c)
      for (Eigen::Index k = 0; k < rows_; ++k)
        out(c * rows_ + k) = AtRow(run.Find(names[static_cast<std::size_t>(c)])->samples, run.rate,
                                   r.data, static_cast<std::size_t>(k) * thin) /
                             readings[static_cast<std::size_t>(c)]->floor;
    return out;
  };
  const Eigen::VectorXd base = simulated(r.scenario);
  error_.setZero(rows_ * readings_);
  for (Eigen::Index c = 0; c < readings_; ++c)
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const MatchedColumn& m = readings[static_cast<std::size_t>(c)]->column;
      const auto at = static_cast<std::size_t>(k) * thin;
      if (m.ok[at]) error_(c * rows_ + k) = m.measured[at] - base(c * rows_ + k);
    }
  moved_ = error_;
  for (std::size_t l = 0; l < r.scenario.loads.size(); ++l) {
    const LoadSpec& load = r.scenario.loads[l];
    stated_.push_back({load.fx, load.fy, load.start, load.stop});
    const double size = std::hypot(load.fx, load.fy);
    for (const bool along_x : {true, false}) {
      Scenario more = r.scenario;
      LoadSpec added = load;
      added.fx = along_x ? size : 0;
      added.fy = along_x ? 0 : size;
      added.stop = r.scenario.duration;
      more.loads.push_back(added);
      steps_.push_back((simulated(more) - base) / size);
      moved_ += (along_x ? load.fx : load.fy) * Answer(steps_.back(), stated_[l], stated_[l]);
    }
  }
  // the controller's own program tells the commands better
  if (HasControllerBlock(alone.rig, r.scenario, r.data) &&
      !ControllerAxes(alone.rig, r.scenario, ControllerRecord(r.data)).empty())
    return;
  for (std::size_t e = 0; e < r.scenario.excitations.size(); ++e) {
    Scenario more = r.scenario;
    more.excitations[e].amplitude *= 1 + kMoreOfCommand;
    commands_.push_back((simulated(more) - base) / kMoreOfCommand);
  }
}

/// To 1 N between the edges of `acting`; `step_answer` begins with `stated`.
Eigen::VectorXd InputTrials::Answer(const Eigen::VectorXd& step_answer, const ActingLoad& stated,
                                    const ActingLoad& acting) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(step_answer.size());
  for (const auto& [edge, sign] : {std::pair{acting.start, 1.0}, std::pair{acting.stop, -1.0}}) {
    const Eigen::Index late = std::lround((edge - stated.start) / step_);
    for (Eigen::Index c = 0; c < readings_; ++c)
      for (Eigen::Index k = std::max<Eigen::Index>(0, late); k < std::min(rows_, rows_ + late); ++k)
        out(c * rows_ + k) += sign * step_answer(c * rows_ + k - late);
  }
  return out;
}

double InputTrials::Fit(std::vector<ActingLoad>& loads) {
  const std::size_t steps = steps_.size();
  Eigen::MatrixXd answers(moved_.size(), static_cast<Eigen::Index>(steps + commands_.size()));
  for (std::size_t k = 0; k < steps; ++k)
    answers.col(static_cast<Eigen::Index>(k)) = Answer(steps_[k], stated_[k / 2], loads[k / 2]);
  for (std::size_t e = 0; e < commands_.size(); ++e)
    answers.col(static_cast<Eigen::Index>(steps + e)) = commands_[e];
  const Eigen::VectorXd with_error = answers.transpose() * moved_;
  Eigen::MatrixXd normal = answers.transpose() * answers;
  normal.diagonal().array() += kRidge * normal.trace();               // of inputs that move nothing
  const Eigen::VectorXd forces = SolveSymmetric(normal, with_error);  // and more of each command
  for (std::size_t l = 0; l < loads.size(); ++l) {
    loads[l].fx = forces(static_cast<Eigen::Index>(2 * l));
    loads[l].fy = forces(static_cast<Eigen::Index>(2 * l + 1));
  }
  sizes_.clear();
  for (std::size_t e = 0; e < commands_.size(); ++e)
    sizes_.push_back(1 + forces(static_cast<Eigen::Index>(steps + e)));
  return Rms(moved_.squaredNorm() - forces.dot(with_error));
}

/// Forces and edges, one edge after the other.
double Seek(InputTrials& trial, std::vector<ActingLoad>& loads) {
  double least = trial.Fit(loads);
  const auto try_edge = [&](std::size_t l, double ActingLoad::*edge, double to) {
    std::vector<ActingLoad> tried = loads;
    tried[l].*edge = to;
    if (!(tried[l].start < tried[l].stop)) return;
    if (const double left = trial.Fit(tried); left < least) least = left, loads = tried;
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t l = 0; l < loads.size(); ++l)
      for (double ActingLoad::*edge : {&ActingLoad::start, &ActingLoad::stop}) {
        const double stated = trial.stated()[l].*edge;
        for (double move = -kLongestMove; move <= kLongestMove; move += kCoarseMove)
          try_edge(l, edge, stated + move);
        const double middle = loads[l].*edge;
        for (double move = -kCoarseMove; move <= kCoarseMove; move += trial.step())
          try_edge(l, edge, middle + move);
      }
  return trial.Fit(loads);
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
    InputTrials trial(model, h, r, columns[r]);
    std::vector<ActingLoad> loads = trial.stated();
    const double left = Seek(trial, loads);
    bool otherwise = CommandedOtherwise(trial.sizes());
    for (std::size_t l = 0; l < loads.size(); ++l)
      otherwise = otherwise || ActsOtherwise(trial.stated()[l], loads[l]);
    if (!(left < std::max(kOtherInputsLeave * trial.before(), kOfNoise)) || !otherwise) continue;
    DataFault f = FaultLeaving(record, "", "scenario", left / trial.before());
    f.detail = LoadsText(loads);
    if (const std::string sizes = CommandSizesText(record.scenario, trial.sizes()); !sizes.empty())
      f.detail += (f.detail.empty() ? "" : "; ") + sizes;
    TellScenario(f, out);
  }
}

}  // namespace ambrig
