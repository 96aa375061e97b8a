#pragma once
/// The search for a distribution matrix W as a nonlinear program in x = [b, wx, wy, T] of the live
/// coils (T only when it is minimised):
///
///   minimise  weight_T T + weight_stiffness lambda_max(kappa(b)) + weight_bias |b|^2 / 8
///             + weight_control (|wx|^2 + |wy|^2) / 8 + weight_error (sum of squares of the errors
///             of the quadratic control terms, when they are no equations) / 2
///   subject to the 12 (or, linearised, the first 6) equations of force_forms.h and to
///             constant + tau T + sigma l'b - r sqrt((l'wx)^2 + (l'wy)^2 + eps^2) >= 0.
///
/// All derivatives are exact; the small eps makes |w| smooth and the bounds a little stricter.
#include <vector>

#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

inline constexpr int kMaxProgramSize = 32;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxProgramSize, 1>;
using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxProgramSize, kMaxProgramSize>;

class DistributionProgram {
 public:
  struct Weights {
    double T = 0, stiffness = 0, bias = 0, control = 0, error = 0;
  };
  struct Bound {
    SmallVector row;  // l
    double sigma, r, tau, constant;
  };

  /// `equations`: 12 exact, 6 linearised.
  DistributionProgram(const RedistributionProblem& problem, const ForceForms& forms, int equations,
                      const Weights& weights);

  /// |b_j| + rho |w_j| <= T (or `limit`); with two quadrants also b_j >= rho |w_j|.
  void BoundCurrents(double rho, double limit = 0);
  /// |B_b| + |B_w| <= T for all eight poles.
  void BoundFluxes();

  int size() const { return 3 * live_count() + (weights_.T > 0); }
  int live_count() const { return static_cast<int>(live_.size()); }
  int equations() const { return equations_; }
  int bounds() const { return static_cast<int>(bounds_.size()); }

  double Objective(const SmallVector& x) const;
  SmallVector ObjectiveGradient(const SmallVector& x) const;
  SmallVector Equations(const SmallVector& x) const;
  SmallMatrix EquationJacobian(const SmallVector& x) const;
  SmallVector Bounds(const SmallVector& x) const;
  SmallMatrix BoundJacobian(const SmallVector& x) const;
  /// Hessian of objective - y' equations - z' bounds.
  SmallMatrix LagrangianHessian(const SmallVector& x, const SmallVector& y,
                                const SmallVector& z) const;

  DistributionMatrix ToMatrix(const SmallVector& x) const;
  /// T, when there is one, is made large enough for its bounds.
  SmallVector FromMatrix(const DistributionMatrix& W) const;

 private:
  Eigen::Vector3d Kappa(const SmallVector& x) const;
  void AddBound(const SmallVector& row, double sigma, double r, double limit);

  const ForceForms& forms_;
  int quadrants_;
  int equations_;
  Weights weights_;
  std::vector<int> live_;
  std::vector<SmallMatrix> G_;  // 12 forms on [b, wx, wy]: equation k is x'G x / 2 - target
  SmallVector target_;          // (12)
  std::array<SmallMatrix, 3> R_;
  std::vector<Bound> bounds_;
};

}  // namespace ambrig
