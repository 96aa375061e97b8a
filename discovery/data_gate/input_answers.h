#pragma once
/// How the readings of a record answer to other inputs than its scenario states: to loads of
/// another force or at other instants, to commands of another size.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

/// Force and edges of a load [N], [s].
struct ActingLoad {
  double fx = 0, fy = 0, start = 0, stop = 0;
};

/// What the model's readings are in one record under any scenario: in floors, thinned, one reading
/// behind the other.
class SimulatedReadings {
 public:
  SimulatedReadings(const CaseModel& model, const Hypothesis& h, std::size_t record,
                    const std::vector<GateColumn>& columns);

  const RigParameters& rig() const { return alone_.rig; }
  const Scenario& scenario() const { return alone_.records[0].scenario; }
  const Record& data() const { return alone_.records[0].data; }
  double step() const { return static_cast<double>(thin_) / data().rate; }  // [s] between rows
  Eigen::Index rows() const { return rows_; }
  Eigen::Index columns() const { return static_cast<Eigen::Index>(columns_.size()); }

  /// @throws std::runtime_error where the model loses its rotor.
  Eigen::VectorXd Under(const Scenario& scenario) const;
  /// Measured less `predicted`; 0 in rows that do not count.
  Eigen::VectorXd ErrorOf(const Eigen::VectorXd& predicted) const;

 private:
  template <class Value>
  Eigen::VectorXd Each(const Value& value) const;
  const Hypothesis& hypothesis_;
  Case alone_;  // the record alone
  std::vector<const GateColumn*> columns_;
  std::vector<std::string> names_;
  std::size_t thin_ = 1;
  Eigen::Index rows_ = 0;
};

/// How the readings of a record answer to the loads and the commands of its scenario.
class InputAnswers {
 public:
  /// @throws std::runtime_error where the model loses its rotor under one of them.
  explicit InputAnswers(const SimulatedReadings& readings);

  const std::vector<ActingLoad>& stated() const { return stated_; }
  double step() const { return readings_.step(); }
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
  const SimulatedReadings& readings_;
  Eigen::VectorXd error_, moved_;  // measured less predicted, without and with the stated loads
  std::vector<ActingLoad> stated_;
  // of each load along x and y: to a step of 1 N that begins with the load and stays
  std::vector<Eigen::VectorXd> steps_;
  std::vector<Eigen::VectorXd> commands_;  // to each excitation once more; empty: not sought
  std::vector<double> sizes_;
};

}  // namespace ambrig
