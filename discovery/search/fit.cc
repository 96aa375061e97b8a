#include "discovery/search/fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <cmath>

#include "discovery/decision/likelihood.h"
#include "discovery/model/jacobian.h"
#include "discovery/search/size_sd.h"
#include "effects/catalogue.h"

namespace ambrig {

namespace {

using Eigen::Index;

constexpr double kEffectStep = 0.01;  // of a parameter's natural step: resonances are narrow
constexpr double kBelieved = 3;       // sd of a rig parameter within its tolerance
constexpr double kBeyond = 5;         // each further sd counts as so many

/// The prior's residual of a rig parameter that stands `sds` from its mean, and its slope. Gaussian
/// within three sd; a part further off is hardly the part of the drawing, and an effect that is
/// missing must not be paid with it.
double PriorResidual(double sds) {
  return sds + std::copysign((kBeyond - 1) * std::max(0.0, std::abs(sds) - kBelieved), sds);
}
double PriorSlope(double sds) { return std::abs(sds) > kBelieved ? kBeyond : 1; }

/// [J r]ᵀ[J r] over the rows of the fit records.
Eigen::MatrixXd FitGram(const CaseModel& model, const Eigen::MatrixXd& J,
                        const std::vector<double>& r) {
  const Index p = J.cols();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p + 1, p + 1);
  for (const Target& t : model.targets()) {
    if (!Counts(model, t, Which::kFit)) continue;
    const auto rows = J.middleRows(static_cast<Index>(t.first), static_cast<Index>(t.count));
    const Eigen::Map<const Eigen::VectorXd> part(r.data() + t.first, static_cast<Index>(t.count));
    gram.topLeftCorner(p, p).noalias() += rows.transpose() * rows;
    gram.topRightCorner(p, 1).noalias() += rows.transpose() * part;
    gram(p, p) += part.squaredNorm();
  }
  gram.bottomLeftCorner(1, p) = gram.topRightCorner(p, 1).transpose();
  return gram;
}

/// The least-squares problem seen through its Gram matrix: with [J r] = Q R the residual Qᵀr and
/// the Jacobian R have the same cost, gradient and Gauss-Newton matrix in a handful of rows.
class CompressedCost : public ceres::CostFunction {
 public:
  CompressedCost(const CaseModel& model, const Hypothesis& start, const FitOptions& options)
      : model_(model), hypothesis_(start), options_(options), p_(start.free.size()) {
    set_num_residuals(static_cast<int>(p_) + 1 + static_cast<int>(p_));  // data, then priors
    mutable_parameter_block_sizes()->push_back(static_cast<int>(p_));
    for (std::size_t k = 0; k < p_; ++k)
      if (start.free[k].effect < 0)
        base_.push_back(k);
      else
        effect_.push_back(k);
  }

  /// Weight of a residual when the model leaves `ratio` times the noise.
  void SetMisfitWeight(double ratio) {
    weight_ = std::sqrt(MisfitWeight(ratio, options_.effective_sample_size) /
                        static_cast<double>(model_.size()));
  }
  /// Sensitivities of the rig parameters are taken anew.
  void Refresh() {
    base_jacobian_.resize(0, 0);
    reuse_ = false;
  }

  Hypothesis At(const double* x) const {
    Hypothesis h = hypothesis_;
    for (std::size_t k = 0; k < p_; ++k) h.Set(k, h.ValueAt(k, x[k]));
    return h;
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Hypothesis h = At(x[0]);
    const auto predicted = model_.Predict(h);
    if (!predicted) return false;
    const std::vector<double> r = Residual(model_, *predicted);
    std::fill_n(residuals, num_residuals(), 0.0);
    for (std::size_t k = 0; k < p_; ++k)
      residuals[p_ + 1 + k] = hypothesis_.free[k].sd > 0 ? PriorResidual(x[0][k]) : 0;
    if (!jacobians || !jacobians[0]) {
      residuals[0] = std::sqrt(FitGram(model_, Eigen::MatrixXd(r.size(), 0), r)(0, 0)) * weight_;
      return true;
    }
    Eigen::MatrixXd gram = weight_ * weight_ * FitGram(model_, FullJacobian(h), r);
    // a prediction that rises lowers the residual
    gram.topRightCorner(static_cast<Index>(p_), 1) *= -1;
    gram.bottomLeftCorner(1, static_cast<Index>(p_)) *= -1;
    gram.diagonal().array() += 1e-12 * gram.diagonal().array().abs() + 1e-14;
    const Eigen::MatrixXd R = gram.llt().matrixU();
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> out(
        jacobians[0], num_residuals(), static_cast<Index>(p_));
    out.setZero();
    out.topRows(static_cast<Index>(p_) + 1) = R.leftCols(static_cast<Index>(p_));
    for (std::size_t k = 0; k <= p_; ++k)
      residuals[k] = R(static_cast<Index>(k), static_cast<Index>(p_));
    for (std::size_t k = 0; k < p_; ++k)
      if (hypothesis_.free[k].sd > 0)
        out(static_cast<Index>(p_ + 1 + k), static_cast<Index>(k)) = PriorSlope(x[0][k]);
    return true;
  }

  /// Columns of all parameters; those of the rig are computed once, those of effects here.
  Eigen::MatrixXd FullJacobian(const Hypothesis& h) const {
    Eigen::MatrixXd J(static_cast<Index>(model_.size()), static_cast<Index>(p_));
    if (base_jacobian_.size() == 0) {
      if (reuse_)
        base_jacobian_ = options_.base_jacobian->leftCols(static_cast<Index>(base_.size()));
      else
        base_jacobian_ = Jacobian(model_, h, base_);
    }
    for (std::size_t k = 0; k < base_.size(); ++k)
      J.col(static_cast<Index>(base_[k])) = base_jacobian_.col(static_cast<Index>(k));
    const Eigen::MatrixXd moving = Jacobian(model_, h, effect_, kEffectStep);
    for (std::size_t k = 0; k < effect_.size(); ++k)
      J.col(static_cast<Index>(effect_[k])) = moving.col(static_cast<Index>(k));
    return J;
  }

  double weight() const { return weight_; }
  const CaseModel& model() const { return model_; }

 private:
  const CaseModel& model_;
  const Hypothesis hypothesis_;
  const FitOptions& options_;
  std::size_t p_;
  double weight_ = 1;
  std::vector<std::size_t> base_, effect_;
  bool reuse_ = options_.base_jacobian != nullptr;
  mutable Eigen::MatrixXd base_jacobian_;
};

/// Sd of a value that acts in whole switching periods: of all values between two steps. 0 for others.
double SdOfWholePeriods(const CaseModel& model, const RigParameters& rig, const FreeParameter& f) {
  const EffectInstance& e = rig.effects[static_cast<std::size_t>(f.effect)];
  const EffectDescription* d = FindEffect(e.name);
  if (!d || d->whole_periods.empty() || e.table[f.row].name != d->whole_periods) return 0;
  return 1 / model.data().rig.amplifier.switching_frequency / std::sqrt(12.0);
}

/// Covariance of the optimum and what a user should know about it.
void EstimateCovariance(const CompressedCost& cost, FitResult& result) {
  Hypothesis& h = result.hypothesis;
  const std::size_t p = h.free.size();
  result.jacobian = cost.FullJacobian(h);
  const auto n = static_cast<Index>(p);
  Eigen::MatrixXd information =
      cost.weight() * cost.weight() *
      FitGram(cost.model(), result.jacobian, result.residual).topLeftCorner(n, n);
  result.sd.assign(p, 0);
  Eigen::VectorXd influence = information.diagonal().cwiseSqrt();
  for (std::size_t k = 0; k < p; ++k)
    information(static_cast<Index>(k), static_cast<Index>(k)) += h.free[k].sd > 0 ? 1.0 : 1e-9;
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  result.size_sd = SdOfSizes(h, information);
  for (std::size_t k = 0; k < p; ++k) {
    const auto i = static_cast<Index>(k);
    const FreeParameter& f = h.free[k];
    const double unit = f.logarithmic ? 0.3 * f.value : f.step;
    result.size_sd[k] *= unit;
    result.sd[k] = unit * std::sqrt(std::max(0.0, covariance(i, i)));
    if (f.effect < 0) continue;
    if (influence(i) < 1e-6) {
      result.warnings.push_back(
          f.path + " has no influence on these records near its value (or acts in discrete steps)");
      result.sd[k] = SdOfWholePeriods(cost.model(), h.rig, f);
      result.size_sd[k] = 0;  // not known from here
      continue;
    }
    result.sd[k] = std::max(result.sd[k], SdOfWholePeriods(cost.model(), h.rig, f));
    if (f.value <= f.lo || f.value >= f.hi)
      result.warnings.push_back(fmt::format("{} is at its bound {}", f.path, f.value));
    for (std::size_t m = 0; m < p; ++m) {
      const auto j = static_cast<Index>(m);
      const double c = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      if (m != k && std::abs(c) > 0.97)
        result.warnings.push_back(
            fmt::format("{} and {} are correlated by {:.3f}", f.path, h.free[m].path, c));
    }
  }
}

/// One pass of the solver from and to x. Returns whether it found a usable point.
bool Solve(CompressedCost& cost, const Hypothesis& start, const FitOptions& options,
           std::vector<double>& x) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, x.data());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const FreeParameter& f = start.free[k];
    const auto bound = [&](double v) {
      return f.logarithmic ? std::log(std::max(v, 1e-300) / f.start) / 0.3 : (v - f.start) / f.step;
    };
    if (std::isfinite(f.lo))
      problem.SetParameterLowerBound(x.data(), static_cast<int>(k), std::min(bound(f.lo), x[k]));
    if (std::isfinite(f.hi))
      problem.SetParameterUpperBound(x.data(), static_cast<int>(k), std::max(bound(f.hi), x[k]));
  }
  ceres::Solver::Options solver;
  solver.max_num_iterations = options.iterations;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.function_tolerance = options.tolerance;
  solver.parameter_tolerance = 1e-4;
  solver.gradient_tolerance = 1e-12;
  solver.initial_trust_region_radius = 10;
  solver.logging_type = ceres::SILENT;
  // bounds by projection: a line search costs many runs
  solver.max_num_line_search_step_size_iterations = 0;
  solver.max_num_consecutive_invalid_steps = 4;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable();
}

void Fail(FitResult& result) {
  result.warnings.push_back("the model loses levitation at this point");
  result.ratio_fit = result.ratio_validate = kInfinity;
}

/// Prediction, ratios and prior's penalty at the hypothesis of the result.
bool EvaluateAtPoint(const CaseModel& model, FitResult& result) {
  const auto predicted = model.Predict(result.hypothesis);
  if (!predicted) return false;
  result.predicted = *predicted;
  result.residual = Residual(model, result.predicted);
  result.ratio_fit = Ratio(model, result.residual, Which::kFit);
  result.ratio_validate = Ratio(model, result.residual, Which::kValidate);
  if (result.ratio_validate == 0) result.ratio_validate = result.ratio_fit;
  result.penalty = 0;
  for (std::size_t k = 0; k < result.hypothesis.free.size(); ++k)
    if (result.hypothesis.free[k].sd > 0)
      result.penalty += std::pow(PriorResidual(result.hypothesis.Coordinate(k)), 2);
  return true;
}

}  // namespace

FitResult Fit(const CaseModel& model, const Hypothesis& start, const FitOptions& options) {
  FitResult result;
  result.hypothesis = start;
  if (!EvaluateAtPoint(model, result)) {
    Fail(result);
    return result;
  }
  result.converged = true;
  if (start.free.empty()) return result;
  CompressedCost cost(model, start, options);
  std::vector<double> x(start.free.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = start.Coordinate(k);
  for (int pass = 0; pass < options.passes && options.iterations > 0; ++pass) {
    const double before = result.ratio_fit;
    cost.SetMisfitWeight(std::min(before, options.reached));
    if (pass > 0) cost.Refresh();
    if (!Solve(cost, start, options, x)) {
      result.converged = pass > 0;
      break;
    }
    result.hypothesis = cost.At(x.data());
    if (!EvaluateAtPoint(model, result)) {
      Fail(result);
      return result;
    }
    if (result.ratio_fit > 0.98 * before || before <= 1) break;
  }
  cost.SetMisfitWeight(result.ratio_fit);
  if (options.sensitivities) EstimateCovariance(cost, result);
  return result;
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
