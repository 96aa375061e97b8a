#pragma once
/// The door to KINSOL, the solver of nonlinear equations in SUNDIALS: F(u) = 0.
///
/// Every return code is checked; a failure is a std::runtime_error with SUNDIALS'
/// own words. Source: Hindmarsh et al. 2005, ACM TOMS 31(3).
#include <functional>
#include <string>
#include <vector>

namespace ambrig {

struct KinsolOutcome {
  std::vector<double> u;
  double residual = 0;  // largest |F| in the given scale
  int iterations = 0;
  bool converged = false;
  std::string message;  // why not
};

/// Solves F(u) = 0 by Newton with line search, dense differenced Jacobian. `u_scale`, `f_scale`:
/// typical sizes of u and F; converged when every |F| / f_scale < tolerance.
KinsolOutcome SolveKinsol(const std::function<void(const double* u, double* F)>& function,
                          const std::vector<double>& start, const std::vector<double>& u_scale,
                          const std::vector<double>& f_scale, double tolerance = 1e-10);

}  // namespace ambrig
