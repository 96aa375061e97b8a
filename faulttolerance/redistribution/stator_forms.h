#pragma once
/// The equations of stator_distribution.h in the entries x = [b, wx, wy] of the coils that are
/// left, b the currents at the problem's load over c0, and their least-squares solution. Errors
/// are over k/2.
#include <Eigen/Dense>
#include <vector>

#include "faulttolerance/redistribution/stator_distribution.h"

namespace ambrig {

class StatorForms {
 public:
  explicit StatorForms(const StatorProblem& problem);

  int live() const { return static_cast<int>(live_.size()); }
  int size() const { return (1 + axes_) * live(); }
  int equations() const { return static_cast<int>(targets_.size()); }
  /// The first ones: the load and nothing else at its command, full gain; what is left beyond them
  /// grows with |v|².
  int linear_equations() const { return axes_ * (1 + axes_); }

  Eigen::VectorXd Errors(const Eigen::VectorXd& x) const;
  Eigen::MatrixXd Jacobian(const Eigen::VectorXd& x) const;
  Eigen::MatrixXd ToMatrix(const Eigen::VectorXd& x) const;  // coils x 3
  Eigen::VectorXd FromMatrix(const Eigen::MatrixXd& W) const;
  double bias(const Eigen::VectorXd& x, int j) const { return x[j]; }
  /// |w| of live coil j and its derivative in x.
  double Control(const Eigen::VectorXd& x, int j, Eigen::VectorXd* slope = nullptr) const;

 private:
  struct Equation {
    int axis, p, q;  // columns of [b, wx, wy]
  };
  Eigen::VectorXd Column(const Eigen::VectorXd& x, int p) const;

  int axes_, coils_;
  double magnet_ = 0;        // 1/c0, 0 without magnets
  Eigen::Vector2d command_;  // of the load, over c0
  std::vector<int> live_;
  Eigen::MatrixXd Q_[2];  // (live + 1) x (live + 1)
  std::vector<Equation> list_;
  Eigen::VectorXd targets_;
};

struct StatorBounds {
  double rho = 0, limit = 0;  // |b| + rho |w| <= limit
  bool unipolar = true;       // b >= rho |w|
  /// Largest violation; 0: all hold.
  double Violation(const StatorForms& forms, const Eigen::VectorXd& x) const;
};

/// Levenberg and Marquardt from x: the first `equations` at full weight, the others at first at
/// `weight_of_others`, the bounds one-sided, the entries times `damping`. Ends on the equations to
/// rounding when they can be met. Returns their largest error.
double SolveStatorForms(const StatorForms& forms, int equations, double weight_of_others,
                        const StatorBounds& bounds, double damping, Eigen::VectorXd& x);

}  // namespace ambrig
