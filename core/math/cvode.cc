#include "core/math/cvode.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>

#include "core/math/sundials.h"

namespace ambrig {

namespace {

using namespace sundials;

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

}  // namespace ambrig
