#pragma once
/// Primal-dual interior point for the small nonconvex programs of distribution_program.h:
/// slacks for the bounds, Newton steps in range and null space of the equations' Jacobian (which
/// may lose rank), the reduced Hessian shifted until it is positive definite, l1 merit function
/// with one second-order correction. Own implementation of the textbook method (Nocedal and Wright,
/// Numerical Optimization, chapter 19).
#include "faulttolerance/redistribution/distribution_program.h"

namespace ambrig {

struct InteriorPointResult {
  SmallVector x;
  double objective;
  double infeasibility;  // largest equation error or bound violation
  int iterations;
  bool converged;
};

InteriorPointResult SolveInteriorPoint(const DistributionProgram& program, SmallVector x,
                                       int max_iterations = 200, double tolerance = 1e-8);

/// Levenberg-Marquardt on the equations alone, from x (T, if any, untouched).
/// Returns the largest error left; stops when an entry leaves +-`limit`.
double SolveEquations(const DistributionProgram& program, SmallVector& x, double limit,
                      int max_iterations = 200);

}  // namespace ambrig
