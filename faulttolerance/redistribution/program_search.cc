#include "faulttolerance/redistribution/program_search.h"

#include <nlopt.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/base/errors.h"

namespace ambrig {
namespace {

constexpr double kConstraintTolerance = 1e-9;
constexpr int kEvaluations = 800;

double Largest(const SmallVector& v) { return v.size() ? v.cwiseAbs().maxCoeff() : 0; }

// NLopt's callbacks: rows of a Jacobian one after the other; a bound is <= 0 there, >= 0 here.

SmallVector Point(unsigned n, const double* x) {
  return Eigen::Map<const Eigen::VectorXd>(x, static_cast<Eigen::Index>(n));
}

void StoreRows(const SmallMatrix& rows, double* out) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index j = 0; j < rows.cols(); ++j) *out++ = rows(i, j);
}

double Objective(unsigned n, const double* x, double* gradient, void* program) {
  const auto& p = *static_cast<const DistributionProgram*>(program);
  const SmallVector at = Point(n, x);
  if (gradient) StoreRows(p.ObjectiveGradient(at), gradient);
  return p.Objective(at);
}

void Equations(unsigned m, double* result, unsigned n, const double* x, double* gradient,
               void* program) {
  const auto& p = *static_cast<const DistributionProgram*>(program);
  const SmallVector at = Point(n, x), errors = p.Equations(at);
  std::copy_n(errors.data(), m, result);
  if (gradient) StoreRows(p.EquationJacobian(at), gradient);
}

void Bounds(unsigned m, double* result, unsigned n, const double* x, double* gradient,
            void* program) {
  const auto& p = *static_cast<const DistributionProgram*>(program);
  const SmallVector at = Point(n, x), bounds = -p.Bounds(at);
  std::copy_n(bounds.data(), m, result);
  if (gradient) StoreRows(-p.BoundJacobian(at), gradient);
}

struct Destroy {
  void operator()(nlopt_opt search) const { nlopt_destroy(search); }
};
using Search = std::unique_ptr<nlopt_opt_s, Destroy>;

}  // namespace

ProgramSearch SearchProgram(const DistributionProgram& program, const SmallVector& x,
                            double tolerance) {
  const Search search(nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(program.size())));
  Require(search != nullptr, "NLopt has memory");
  void* data = const_cast<DistributionProgram*>(&program);  // read only
  const std::vector<double> equal(static_cast<std::size_t>(program.equations()),
                                  kConstraintTolerance),
      bound(static_cast<std::size_t>(program.bounds()), kConstraintTolerance);
  nlopt_set_min_objective(search.get(), Objective, data);
  if (!equal.empty())
    nlopt_add_equality_mconstraint(search.get(), static_cast<unsigned>(equal.size()), Equations,
                                   data, equal.data());
  if (!bound.empty())
    nlopt_add_inequality_mconstraint(search.get(), static_cast<unsigned>(bound.size()), Bounds,
                                     data, bound.data());
  nlopt_set_ftol_rel(search.get(), tolerance);
  nlopt_set_xtol_rel(search.get(), tolerance);
  nlopt_set_maxeval(search.get(), kEvaluations);
  std::vector<double> at(x.data(), x.data() + x.size());
  double least = 0;
  nlopt_optimize(search.get(), at.data(), &least);  // also where it fails: its last point counts
  ProgramSearch out;
  out.x = Point(static_cast<unsigned>(at.size()), at.data());
  if (!out.x.allFinite()) out.x = x;
  out.objective = program.Objective(out.x);
  const SmallVector left = program.Bounds(out.x);
  out.infeasibility =
      std::max(Largest(program.Equations(out.x)), left.size() ? -left.minCoeff() : 0.0);
  return out;
}

double SolveEquations(const DistributionProgram& program, SmallVector& x, double limit,
                      int max_iterations) {
  double damping = 1e-2;
  SmallVector c = program.Equations(x);
  for (int k = 0; k < max_iterations && Largest(c) > 1e-15; ++k) {
    const SmallMatrix A = program.EquationJacobian(x);
    SmallMatrix N = A * A.transpose();
    N.diagonal().array() += damping * c.norm();  // goes to zero with the error: fast at the end
    const SmallVector trial = x - A.transpose() * N.ldlt().solve(c);
    const SmallVector error = program.Equations(trial);
    if (error.norm() < c.norm()) {
      x = trial;
      c = error;
      damping = std::max(damping / 3, 1e-12);
    } else {
      damping *= 4;
      if (damping * c.norm() > 1e12) break;
    }
    if (Largest(x.head(3 * program.live_count())) > limit) return Largest(c) + 1;
  }
  return Largest(c);
}

}  // namespace ambrig
