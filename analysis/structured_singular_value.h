#pragma once
/// Structured singular value μ(M) of a square matrix for independent complex scalars on its
/// diagonal: 1/μ is the size of the smallest Δ = diag(δ_1 ... δ_n) with det(I - M Δ) = 0.
///
///   upper   min over D = diag(d) > 0 of σ_max(D M D⁻¹): convex in log d, by the ellipsoid method,
///     which
///           knows how far from the minimum it still is. For n up to 3 this minimum is μ itself
///   lower   max over phases Q of ρ(M Q), a local one by power iteration: a Δ that does it
///
/// Sources: Packard, Doyle: The complex structured singular value, Automatica 29 (1993); Grötschel,
/// Lovász, Schrijver: Geometric Algorithms and Combinatorial Optimization (1988), section 3.1.
#include <Eigen/Dense>

namespace ambrig {

struct MuUpper {
  double value = 0;         // an upper bound of μ
  Eigen::VectorXd scaling;  // log d
};

/// One balancing of rows against columns (Osborne): quick, at most a few per cent too high as a
/// rule.
MuUpper BalancedUpperBound(const Eigen::MatrixXcd& M);

/// The best scaling to within `accuracy` of the bound's logarithm.
MuUpper LeastUpperBound(const Eigen::MatrixXcd& M, double accuracy = 1e-4);

struct MuLower {
  double value = 0;  // a lower bound of μ
  // det(I - M diag(delta)) = 0, every |delta| = 1/value; empty when value is 0
  Eigen::VectorXcd delta;
};

MuLower LargestLowerBound(const Eigen::MatrixXcd& M);

}  // namespace ambrig
