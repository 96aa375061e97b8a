#include "discovery/search/fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/linear_equations.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/fit_problem.h"
#include "discovery/search/rig_prior.h"
#include "discovery/search/size_sd.h"
#include "discovery/search/whole_periods.h"

namespace ambrig {

namespace {

using Eigen::Index;

/// Covariance of the optimum and what a user should know about it.
void EstimateCovariance(const FitProblem& cost, FitResult& result) {
  Hypothesis& h = result.hypothesis;
  const std::size_t p = h.free.size();
  result.jacobian = cost.FullJacobian(h);
  const auto n = static_cast<Index>(p);
  Eigen::MatrixXd information = cost.Information(result.jacobian);
  result.sd.assign(p, 0);
  Eigen::VectorXd influence = information.diagonal().cwiseSqrt();
  AddPriorInformation(h, information);
  const Eigen::MatrixXd covariance =
      SolveSymmetricColumns(information, Eigen::MatrixXd::Identity(n, n));
  result.size_sd = SdOfSizes(h, information);
  for (std::size_t k = 0; k < p; ++k) {
    const auto i = static_cast<Index>(k);
    const FreeParameter& f = h.free[k];
    const double unit = f.logarithmic ? 0.3 * f.value : f.step;
    result.size_sd[k] *= unit;
    result.sd[k] = unit * std::sqrt(std::max(0.0, covariance(i, i)));
    if (f.effect < 0) continue;
    if (const double period = WholePeriodOf(cost.model(), h, f)) {
      result.sd[k] = period / std::sqrt(12.0);  // of all values between two steps
      result.size_sd[k] = 0;                    // not known from here
      continue;
    }
    if (influence(i) < 1e-6) {
      result.warnings.push_back(f.path + " has no influence on these records near its value");
      result.sd[k] = result.size_sd[k] = 0;  // not known from here
      continue;
    }
    if (f.value <= f.lo || f.value >= f.hi)
      result.warnings.push_back(fmt::format("{} is at its bound {}", f.path, f.value));
    for (std::size_t m = 0; m < p; ++m) {
      const auto j = static_cast<Index>(m);
      const double c = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      const bool told = m < k && h.free[m].effect >= 0;  // with the other name first
      if (m != k && !told && std::abs(c) > 0.97)
        result.warnings.push_back(
            fmt::format("{} and {} are correlated by {:.3f}", f.path, h.free[m].path, c));
    }
  }
}

/// The problem as Ceres asks for it.
class SolverCost : public ceres::CostFunction {
 public:
  explicit SolverCost(const FitProblem& problem) : problem_(problem) {
    set_num_residuals(problem.num_residuals());
    mutable_parameter_block_sizes()->push_back(problem.parameters());
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    return problem_.Evaluate(x, residuals, jacobians);
  }

 private:
  const FitProblem& problem_;
};

/// Ends a pass with the step that gains a small share of what the pass has gained, and little.
class EnoughGained : public ceres::IterationCallback {
 public:
  explicit EnoughGained(double least_share) : least_share_(least_share) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (step.iteration == 0 || !step.step_is_successful) return ceres::SOLVER_CONTINUE;
    gained_ += step.cost_change;
    constexpr double kLittle = 1;  // of log posterior
    return step.cost_change < std::min(kLittle, least_share_ * gained_)
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  }

 private:
  double least_share_, gained_ = 0;
};

/// One pass of the solver from and to x. Returns whether it found a usable point.
bool Solve(FitProblem& cost, const FitOptions& options, std::vector<double>& x) {
  SolverCost seen(cost);  // outlives the problem, which does not own it
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&seen, nullptr, x.data());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double low = cost.LowerBound(k), high = cost.UpperBound(k);
    if (std::isfinite(low))
      problem.SetParameterLowerBound(x.data(), static_cast<int>(k), std::min(low, x[k]));
    if (std::isfinite(high))
      problem.SetParameterUpperBound(x.data(), static_cast<int>(k), std::max(high, x[k]));
  }
  ceres::Solver::Options solver;
  solver.max_num_iterations = options.iterations;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.function_tolerance = options.tolerance;
  solver.parameter_tolerance = 1e-4;
  solver.gradient_tolerance = 1e-12;
  solver.initial_trust_region_radius = options.trust_region;
  solver.logging_type = ceres::SILENT;
  // bounds by projection: a line search costs many runs
  solver.max_num_line_search_step_size_iterations = 0;
  solver.max_num_consecutive_invalid_steps = 4;
  EnoughGained enough(options.least_share);
  solver.callbacks = {&enough};
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable();
}

void Fail(FitResult& result) {
  result.warnings.push_back("the model loses levitation at this point");
  result.ratio_fit = result.ratio_validate = kInfinity;
  result.converged = false;
}

/// Prediction, ratios and prior's penalty at the hypothesis of the result; with a `look` of its
/// records only, which leaves the other ratio without meaning.
bool EvaluateAtPoint(const CaseModel& model, const RecordSubset* look, FitResult& result) {
  const auto predicted = model.PredictAll({result.hypothesis}, ModelFidelity::kAsSampled, look)[0];
  if (!predicted) return false;
  result.predicted = *predicted;
  result.residual = Residual(model, result.predicted, look);
  result.ratio_fit = Ratio(model, result.residual, Which::kFit);
  result.ratio_validate = Ratio(model, result.residual, Which::kValidate);
  if (result.ratio_validate == 0) result.ratio_validate = result.ratio_fit;
  result.penalty = PriorPenalty(result.hypothesis);
  return true;
}

/// Moves every parameter that acts in whole switching periods to the neighbouring period that
/// lowers the cost most. Returns whether one was moved.
bool StepByPeriods(const CaseModel& model, const FitProblem& cost, FitResult& result) {
  bool moved = false;
  for (std::size_t k = 0; k < result.hypothesis.free.size(); ++k) {
    const FreeParameter f = result.hypothesis.free[k];
    const double period = WholePeriodOf(model, result.hypothesis, f);
    if (period == 0) continue;
    for (const double by : {-period, period}) {
      FitResult there = result;
      there.hypothesis.Set(k, std::clamp(f.value + by, f.lo, f.hi));
      if (!EvaluateAtPoint(model, &cost.look(), there) || there.ratio_fit >= result.ratio_fit)
        continue;
      result = std::move(there);
      moved = true;
    }
  }
  return moved;
}

/// Passes of the solver from the hypothesis of the result, which is evaluated on all records at the
/// end. false: nothing to go on with; the result says so.
bool Improve(const CaseModel& model, const FitOptions& options, FitProblem& cost,
             FitResult& result) {
  const Hypothesis start = result.hypothesis;
  std::vector<double> x(start.free.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = start.Coordinate(k);
  bool refreshed = false;
  for (int pass = 0; pass < options.passes; ++pass) {
    const double before = result.ratio_fit, penalty = result.penalty;
    cost.SetMisfitWeight(std::min(before, options.reached));
    if (pass > 0 && options.sensitivities &&
        (!refreshed || cost.OutsideOfSensitivities(result.hypothesis))) {
      cost.Refresh();
      refreshed = true;
    }
    if (!Solve(cost, options, x)) {
      result.converged = pass > 0;
      break;
    }
    result.hypothesis = cost.At(x.data());
    if (!EvaluateAtPoint(model, &cost.look(), result)) {
      Fail(result);
      return false;
    }
    if (StepByPeriods(model, cost, result)) {
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = result.hypothesis.Coordinate(k);
      cost.Refresh();
      continue;
    }
    const double gain = cost.MisfitBetween(before, result.ratio_fit) + penalty - result.penalty;
    if (options.least_gain > 0 ? gain < options.least_gain
                               : result.ratio_fit > 0.98 * before || before <= 1)
      break;
  }
  if (EvaluateAtPoint(model, nullptr, result)) return true;
  Fail(result);
  return false;
}

}  // namespace

FitResult Fit(const CaseModel& model, const Hypothesis& start, const FitOptions& options) {
  FitResult result;
  result.hypothesis = start;
  FitProblem cost(model, start, options);
  const bool moves = !start.free.empty() && options.iterations > 0;
  if (!EvaluateAtPoint(model, moves ? &cost.look() : nullptr, result)) {
    Fail(result);
    return result;
  }
  result.converged = true;
  if (start.free.empty()) return result;
  if (moves && !Improve(model, options, cost, result)) return result;
  cost.SetMisfitWeight(result.ratio_fit);
  if (options.sensitivities) EstimateCovariance(cost, result);
  return result;
}

bool HoldsAdopted(const CaseModel& model, const FitResult& fit) {
  return fit.hypothesis.rig.effects.size() > model.data().rig.effects.size();
}

void AddPriorInformation(const Hypothesis& h, Eigen::MatrixXd& information) {
  for (Index k = 0; k < information.rows(); ++k)
    information(k, k) += h.free[static_cast<std::size_t>(k)].sd > 0 ? 1.0 : 1e-9;
}

EffectInstance FittedEffect(const FitResult& fit, std::size_t index) {
  EffectInstance e = fit.hypothesis.rig.effects[index];
  for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k) {
    const FreeParameter& p = fit.hypothesis.free[k];
    if (p.effect == static_cast<int>(index) && k < fit.sd.size()) e.sd[p.row] = fit.sd[k];
  }
  return e;
}

}  // namespace ambrig
