#include "discovery/data_gate/input_answers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/linear_equations.h"
#include "core/record/channels.h"
#include "discovery/data_gate/program_error.h"
#include "discovery/model/record_rows.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr std::size_t kMostInputRows = 2000;  // longer records are thinned
constexpr double kMoreOfCommand = 0.1;        // by which a command is changed
constexpr double kRidge = 1e-12;

}  // namespace

SimulatedReadings::SimulatedReadings(const CaseModel& model, const Hypothesis& h,
                                     std::size_t record, const std::vector<GateColumn>& columns)
    : hypothesis_(h), alone_(model.data()) {
  alone_.records = {model.data().records[record]};
  for (const GateColumn& c : columns)
    if (IsOfKind(c.name, ChannelKind::kReading)) columns_.push_back(&c), names_.push_back(c.name);
  thin_ = std::max<std::size_t>(1, data().rows() / kMostInputRows);
  rows_ = static_cast<Index>(data().rows() / thin_);
}

template <class Value>
Eigen::VectorXd SimulatedReadings::Each(const Value& value) const {
  Eigen::VectorXd out(rows_ * columns());
  for (Index c = 0; c < columns(); ++c)
    for (Index k = 0; k < rows_; ++k)
      out(c * rows_ + k) = value(static_cast<std::size_t>(c), static_cast<std::size_t>(k) * thin_);
  return out;
}

Eigen::VectorXd SimulatedReadings::Under(const Scenario& scenario) const {
  Case changed = alone_;
  changed.records[0].scenario = scenario;
  const Record run = CaseModel(std::move(changed)).Simulated(hypothesis_, 0, false, 1, names_);
  return Each([&](std::size_t c, std::size_t row) {
    return AtRow(run.Find(names_[c])->samples, run.rate, data(), row) / columns_[c]->floor;
  });
}

Eigen::VectorXd SimulatedReadings::ErrorOf(const Eigen::VectorXd& predicted) const {
  const Eigen::VectorXd measured =
      Each([&](std::size_t c, std::size_t row) { return columns_[c]->column.measured[row]; });
  const Eigen::VectorXd counts =
      Each([&](std::size_t c, std::size_t row) { return columns_[c]->column.ok[row] ? 1 : 0; });
  return counts.cwiseProduct(measured - predicted);
}

InputAnswers::InputAnswers(const SimulatedReadings& readings) : readings_(readings) {
  const Scenario& scenario = readings.scenario();
  const Eigen::VectorXd base = readings.Under(scenario);
  moved_ = error_ = readings.ErrorOf(base);
  for (const LoadSpec& load : scenario.loads) {
    stated_.push_back({load.fx, load.fy, load.start, load.stop});
    const double size = std::hypot(load.fx, load.fy);
    for (const bool along_x : {true, false}) {
      Scenario more = scenario;
      LoadSpec added = load;
      added.fx = along_x ? size : 0;
      added.fy = along_x ? 0 : size;
      added.stop = scenario.duration;
      more.loads.push_back(added);
      steps_.push_back((readings.Under(more) - base) / size);
      moved_ +=
          (along_x ? load.fx : load.fy) * Answer(steps_.back(), stated_.back(), stated_.back());
    }
  }
  // the controller's own program tells the commands better
  if (HasControllerBlock(readings.rig(), scenario, readings.data()) &&
      !ControllerAxes(readings.rig(), scenario, ControllerRecord(readings.data())).empty())
    return;
  for (std::size_t e = 0; e < scenario.excitations.size(); ++e) {
    Scenario more = scenario;
    more.excitations[e].amplitude *= 1 + kMoreOfCommand;
    commands_.push_back((readings.Under(more) - base) / kMoreOfCommand);
  }
}

/// To 1 N between the edges of `acting`; `step_answer` begins with `stated`.
Eigen::VectorXd InputAnswers::Answer(const Eigen::VectorXd& step_answer, const ActingLoad& stated,
                                     const ActingLoad& acting) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(step_answer.size());
  const Index rows = readings_.rows();
  for (const auto& [edge, sign] : {std::pair{acting.start, 1.0}, std::pair{acting.stop, -1.0}}) {
    const Index late = std::lround((edge - stated.start) / step());
    const Index n = rows - std::abs(late);  // rows that are left of each reading
    if (n <= 0) continue;
    for (Index c = 0; c < readings_.columns(); ++c)
      out.segment(c * rows + std::max<Index>(0, late), n) +=
          sign * step_answer.segment(c * rows + std::max<Index>(0, -late), n);
  }
  return out;
}

double InputAnswers::Fit(std::vector<ActingLoad>& loads) {
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

}  // namespace ambrig
