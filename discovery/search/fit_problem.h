#pragma once
/// The least-squares problem of a fit, without its solver. Internal to discovery.
#include <Eigen/Dense>
#include <vector>

#include "discovery/model/jacobian.h"
#include "discovery/search/fit.h"

namespace ambrig {

/// The least-squares problem seen through its Gram matrix: with [J r] = Q R the residual Qᵀr and
/// the Jacobian R have the same cost, gradient and Gauss-Newton matrix in a handful of rows.
class FitProblem {
 public:
  FitProblem(const CaseModel& model, const Hypothesis& start, const FitOptions& options);

  /// Weight of a residual when the model leaves `ratio` times the noise.
  void SetMisfitWeight(double ratio);
  /// What 2 log likelihood of the rows looked at rises by from one ratio to a smaller one, at the
  /// weight set.
  double MisfitBetween(double before, double after) const;
  /// Sensitivities of the rig parameters are taken again.
  void Refresh();
  /// Whether a rig parameter of `h` lies beyond the neighbourhood of the point where the
  /// sensitivities of the rig parameters were taken.
  bool OutsideOfSensitivities(const Hypothesis& h) const;

  Hypothesis At(const double* x) const;

  /// Bounds of a parameter's coordinate.
  double LowerBound(std::size_t k) const { return BoundOf(k, hypothesis_.free[k].lo); }
  double UpperBound(std::size_t k) const { return BoundOf(k, hypothesis_.free[k].hi); }

  int parameters() const { return static_cast<int>(p_); }
  int num_residuals() const { return 2 * static_cast<int>(p_) + 1; }  // data, then priors

  /// As ceres::CostFunction::Evaluate.
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const;

  /// Columns of all parameters on the records looked at; those of the rig are computed once a pass,
  /// those of effects here.
  Eigen::MatrixXd FitJacobian(const Hypothesis& h) const;
  /// The same on all records: the rig's where the last pass took them (in memory for what it looked
  /// at).
  Eigen::MatrixXd FullJacobian(const Hypothesis& h) const;

  /// What the records looked at tell of all parameters, by their sensitivities on all rows: a row
  /// counts as the numbers that it is worth, where that is known.
  Eigen::MatrixXd Information(const Eigen::MatrixXd& jacobian) const;

  double weight() const { return weight_; }
  const CaseModel& model() const { return model_; }
  const RecordSubset& look() const { return look_; }

 private:
  /// Broyden's rank-one correction of the sensitivities by the step from where they were last used:
  /// they then tell the change of the residual to `r` exactly. Besides saving simulations it takes
  /// away what the jumps of the predictions add to small differences, which makes steps too small.
  /// false: they told too little of the change to go on with. Source: Nocedal and Wright,
  /// "Numerical Optimization", 2nd ed., 11.1.
  bool CorrectBySecant(const double* x, const std::vector<double>& r) const;
  double BoundOf(std::size_t k, double value) const;
  /// A parameter at a bound which the slope of the cost pushes against is held there: its column is
  /// zero. Ceres projects steps into the bounds only after it has computed them, and the other
  /// parameters would go with one that cannot move. Source: D. P. Bertsekas, SIAM J. Control Optim.
  /// 20 (1982), projected Newton. `residuals`: num_residuals() values, `jacobian`: as many rows.
  void HoldAtBounds(
      const double* x, const double* residuals,
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& jacobian)
      const;
  /// The columns of the rig beside those of the effects at `h`.
  Eigen::MatrixXd Joined(const Eigen::MatrixXd& of_rig, const Hypothesis& h,
                         const RecordSubset* look) const;

  const CaseModel& model_;
  const Hypothesis hypothesis_;
  const FitOptions& options_;
  const RecordSubset look_;
  std::size_t p_;
  double weight_ = 1;
  std::vector<std::size_t> base_, effect_, tuned_;  // tuned: of effects that have a frequency
  std::vector<std::size_t> stepped_;                // act in whole switching periods: no slope
  bool reuse_ = false;                              // the columns that another fit lends
  mutable Eigen::MatrixXd base_jacobian_;
  mutable Hypothesis base_at_;  // where it was taken
  // of all parameters, and where they were last used with what residual
  mutable Eigen::MatrixXd jacobian_;
  mutable std::vector<double> at_, residual_;
};

}  // namespace ambrig
