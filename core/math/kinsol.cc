#include "core/math/kinsol.h"

#include <kinsol/kinsol.h>

#include "core/math/sundials.h"

namespace ambrig {

namespace {

using namespace sundials;

struct KinsolProblem {
  const std::function<void(const double*, double*)>* function;
  std::size_t size;
  Report report;
  static int Function(N_Vector u, N_Vector F, void* data) {
    auto* self = static_cast<KinsolProblem*>(data);
    double* out = N_VGetArrayPointer(F);
    return self->report.Guard(out, self->size,
                              [&] { (*self->function)(N_VGetArrayPointer(u), out); });
  }
};

void FreeKinsol(void* memory) { KINFree(&memory); }

std::vector<double> Inverse(std::vector<double> v) {
  for (double& x : v) x = 1 / x;
  return v;
}

}  // namespace

KinsolOutcome SolveKinsol(const std::function<void(const double* u, double* F)>& function,
                          const std::vector<double>& start, const std::vector<double>& u_scale,
                          const std::vector<double>& f_scale, double tolerance) {
  const std::size_t n = start.size();
  Require(u_scale.size() == n && f_scale.size() == n, "one scale per unknown and equation");
  const Context context;
  KinsolProblem problem{&function, n, {}};
  Report& report = problem.report;
  const Vector u(NewVector(start, context)), us(NewVector(Inverse(u_scale), context)),
      fs(NewVector(Inverse(f_scale), context));
  const Matrix matrix(
      SUNDenseMatrix(static_cast<sunindextype>(n), static_cast<sunindextype>(n), context));
  const Linear linear(SUNLinSol_Dense(u, matrix, context));
  const Owned<void*, FreeKinsol> memory(KINCreate(context));
  report.Check(KINSetErrHandlerFn(memory, Report::Handler, &report), "KINSetErrHandlerFn");
  report.Check(KINSetUserData(memory, &problem), "KINSetUserData");
  report.Check(KINInit(memory, KinsolProblem::Function, u), "KINInit");
  report.Check(KINSetLinearSolver(memory, linear, matrix), "KINSetLinearSolver");
  report.Check(KINSetFuncNormTol(memory, tolerance), "KINSetFuncNormTol");
  report.Check(KINSetMaxSetupCalls(memory, 1), "KINSetMaxSetupCalls");
  report.Check(KINSetNumMaxIters(memory, 200), "KINSetNumMaxIters");
  const int code = KINSol(memory, u, KIN_LINESEARCH, us, fs);
  if (report.thrown) report.Check(code, "KINSol");
  KinsolOutcome out;
  out.u.assign(N_VGetArrayPointer(u), N_VGetArrayPointer(u) + n);
  std::vector<double> F(n);
  function(out.u.data(), F.data());
  for (std::size_t k = 0; k < n; ++k)
    out.residual = std::max(out.residual, std::abs(F[k]) / f_scale[k]);
  long iterations = 0;
  report.Check(KINGetNumNonlinSolvIters(memory, &iterations), "KINGetNumNonlinSolvIters");
  out.iterations = static_cast<int>(iterations);
  // A line search that cannot go on is fine where the residual is already small.
  out.converged = out.residual <= tolerance;
  if (!out.converged)
    out.message =
        report.message.empty() ? fmt::format("KINSol ended with code {}", code) : report.message;
  return out;
}

}  // namespace ambrig
