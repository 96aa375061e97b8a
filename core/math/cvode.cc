#include "core/math/cvode.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

#include "core/base/errors.h"

namespace ambrig {

namespace {

/// Frees a SUNDIALS object whose destructor takes it by value.
template <typename T, void (*kFree)(T)>
struct Owned {
  T value = nullptr;
  Owned() = default;
  explicit Owned(T v) : value(v) { Require(v != nullptr, "SUNDIALS has memory"); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (value) kFree(value);
  }
  operator T() const { return value; }
};
void FreeMatrix(SUNMatrix m) { SUNMatDestroy(m); }
void FreeLinear(SUNLinearSolver s) { SUNLinSolFree(s); }
void FreeVector(N_Vector v) { N_VDestroy(v); }
using Vector = Owned<N_Vector, FreeVector>;
using Matrix = Owned<SUNMatrix, FreeMatrix>;
using Linear = Owned<SUNLinearSolver, FreeLinear>;

struct Context {
  SUNContext value = nullptr;
  Context() { Require(SUNContext_Create(nullptr, &value) == 0, "a SUNDIALS context"); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { SUNContext_Free(&value); }
  operator SUNContext() const { return value; }
};

N_Vector NewVector(const std::vector<double>& v, SUNContext context) {
  N_Vector out = N_VNew_Serial(static_cast<sunindextype>(v.size()), context);
  if (out) std::copy(v.begin(), v.end(), N_VGetArrayPointer(out));
  return out;
}

/// SUNDIALS' last words and what a callback threw (it must not pass through C code).
struct Report {
  std::string message;
  std::exception_ptr thrown;

  static void Handler(int code, const char* module, const char* function, char* text, void* data) {
    if (code < 0)
      static_cast<Report*>(data)->message = fmt::format("{} {}: {}", module, function, text);
  }
  /// 0 fine, 1 try again with a smaller step, -1 give up.
  template <typename Call>
  int Guard(double* out, std::size_t n, const Call& call) {
    try {
      call();
    } catch (...) {
      thrown = std::current_exception();
      return -1;
    }
    for (std::size_t k = 0; k < n; ++k)
      if (!std::isfinite(out[k])) return 1;
    return 0;
  }
  void Check(int code, const char* what) {
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
    if (code >= 0) return;
    throw std::runtime_error(message.empty() ? fmt::format("{} failed with code {}", what, code)
                                             : message);
  }
};

/// What both integrators have in common.
struct Integrator {
  OdeProblem problem;
  Context context;
  Report report;
  Vector y, absolute;
  std::vector<int> found;
  void* memory = nullptr;

  explicit Integrator(OdeProblem p)
      : problem(std::move(p)),
        y(NewVector(std::vector<double>(problem.size, 0.0), context)),
        absolute(NewVector(problem.absolute, context)),
        found(static_cast<std::size_t>(problem.roots), 0) {
    Require(problem.absolute.size() == problem.size, "one absolute tolerance per state");
    Require(problem.roots == 0 || problem.root, "a function for the roots");
    Require(problem.directions.empty() || problem.directions.size() == found.size(),
            "one direction per root");
  }
  static int Rhs(double t, N_Vector state, N_Vector rate, void* data) {
    auto* self = static_cast<Integrator*>(data);
    double* out = N_VGetArrayPointer(rate);
    return self->report.Guard(out, self->problem.size,
                              [&] { self->problem.rhs(t, N_VGetArrayPointer(state), out); });
  }
  static int Root(double t, N_Vector state, double* out, void* data) {
    auto* self = static_cast<Integrator*>(data);
    return self->report.Guard(out, self->found.size(),
                              [&] { self->problem.root(t, N_VGetArrayPointer(state), out); });
  }
  void Load(const std::vector<double>& from) {
    Require(from.size() == problem.size, "a state of the problem's size");
    std::copy(from.begin(), from.end(), N_VGetArrayPointer(y));
  }
  void Store(std::vector<double>& to) const {
    to.assign(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + problem.size);
  }
};

}  // namespace

struct Arkode::Impl : Integrator {
  long steps_before = 0;

  Impl(OdeProblem p, int order) : Integrator(std::move(p)) {
    memory = ERKStepCreate(Rhs, 0, y, context);
    Require(memory != nullptr, "ARKODE has memory");
    report.Check(ERKStepSetErrHandlerFn(memory, Report::Handler, &report),
                 "ERKStepSetErrHandlerFn");
    report.Check(ERKStepSetUserData(memory, static_cast<Integrator*>(this)), "ERKStepSetUserData");
    report.Check(ERKStepSetOrder(memory, order), "ERKStepSetOrder");
    report.Check(ERKStepSVtolerances(memory, problem.relative, absolute), "ERKStepSVtolerances");
    report.Check(ERKStepSetMaxNumSteps(memory, problem.max_steps), "ERKStepSetMaxNumSteps");
    if (problem.roots == 0) return;
    report.Check(ERKStepRootInit(memory, problem.roots, Root), "ERKStepRootInit");
    report.Check(ERKStepSetNoInactiveRootWarn(memory), "ERKStepSetNoInactiveRootWarn");
    if (!problem.directions.empty())
      report.Check(ERKStepSetRootDirection(memory, problem.directions.data()),
                   "ERKStepSetRootDirection");
  }
  ~Impl() { ERKStepFree(&memory); }
};

Arkode::Arkode(OdeProblem problem, int order)
    : impl_(std::make_unique<Impl>(std::move(problem), order)) {}
Arkode::~Arkode() = default;

void Arkode::Restart(double t, const std::vector<double>& y, double first_step) {
  impl_->Load(y);
  impl_->report.Check(ERKStepReset(impl_->memory, t, impl_->y), "ERKStepReset");
  impl_->report.Check(ERKStepSetInitStep(impl_->memory, first_step), "ERKStepSetInitStep");
  impl_->steps_before = 0;
  impl_->steps_before = steps();
}

OdeSolver::Outcome Arkode::Advance(double stop, std::vector<double>& y) {
  Outcome out;
  impl_->report.Check(ERKStepSetStopTime(impl_->memory, stop), "ERKStepSetStopTime");
  const int code = ERKStepEvolve(impl_->memory, stop, impl_->y, &out.t, ARK_NORMAL);
  impl_->report.Check(code, "ERKStepEvolve");
  out.root = code == ARK_ROOT_RETURN;
  if (out.root)
    impl_->report.Check(ERKStepGetRootInfo(impl_->memory, impl_->found.data()),
                        "ERKStepGetRootInfo");
  impl_->Store(y);
  return out;
}

const std::vector<int>& Arkode::roots() const { return impl_->found; }

long Arkode::steps() const {
  long n = 0;
  impl_->report.Check(ERKStepGetNumSteps(impl_->memory, &n), "ERKStepGetNumSteps");
  return n - impl_->steps_before;
}

struct Cvode::Impl : Integrator {
  Matrix matrix;
  Linear linear;
  explicit Impl(OdeProblem p)
      : Integrator(std::move(p)),
        matrix(SUNDenseMatrix(static_cast<sunindextype>(problem.size),
                              static_cast<sunindextype>(problem.size), context)),
        linear(SUNLinSol_Dense(y, matrix, context)) {
    memory = CVodeCreate(CV_BDF, context);
    Require(memory != nullptr, "CVODE has memory");
    report.Check(CVodeSetErrHandlerFn(memory, Report::Handler, &report), "CVodeSetErrHandlerFn");
    report.Check(CVodeSetUserData(memory, static_cast<Integrator*>(this)), "CVodeSetUserData");
    report.Check(CVodeInit(memory, Rhs, 0, y), "CVodeInit");
    report.Check(CVodeSVtolerances(memory, problem.relative, absolute), "CVodeSVtolerances");
    report.Check(CVodeSetLinearSolver(memory, linear, matrix), "CVodeSetLinearSolver");
    report.Check(CVodeSetMaxNumSteps(memory, problem.max_steps), "CVodeSetMaxNumSteps");
    if (problem.roots == 0) return;
    report.Check(CVodeRootInit(memory, problem.roots, Root), "CVodeRootInit");
    report.Check(CVodeSetNoInactiveRootWarn(memory), "CVodeSetNoInactiveRootWarn");
    if (!problem.directions.empty())
      report.Check(CVodeSetRootDirection(memory, problem.directions.data()),
                   "CVodeSetRootDirection");
  }
  ~Impl() { CVodeFree(&memory); }
};

Cvode::Cvode(OdeProblem problem) : impl_(std::make_unique<Impl>(std::move(problem))) {}
Cvode::~Cvode() = default;

void Cvode::Restart(double t, const std::vector<double>& y, double /*first_step*/) {
  // Order one needs its own small first step; CVODE finds it.
  impl_->Load(y);
  impl_->report.Check(CVodeReInit(impl_->memory, t, impl_->y), "CVodeReInit");
}

OdeSolver::Outcome Cvode::Advance(double stop, std::vector<double>& y) {
  Outcome out;
  impl_->report.Check(CVodeSetStopTime(impl_->memory, stop), "CVodeSetStopTime");
  const int code = CVode(impl_->memory, stop, impl_->y, &out.t, CV_NORMAL);
  impl_->report.Check(code, "CVode");
  out.root = code == CV_ROOT_RETURN;
  if (out.root)
    impl_->report.Check(CVodeGetRootInfo(impl_->memory, impl_->found.data()), "CVodeGetRootInfo");
  impl_->Store(y);
  return out;
}

const std::vector<int>& Cvode::roots() const { return impl_->found; }

long Cvode::steps() const {
  long n = 0;
  impl_->report.Check(CVodeGetNumSteps(impl_->memory, &n), "CVodeGetNumSteps");
  return n;
}

namespace {

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
