#include "discovery/fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <cmath>

#include "discovery/jacobian.h"

namespace ambrig {

namespace {

using Eigen::Index;

/// The least-squares problem seen through its Gram matrix: with [J r] = Q R the residual Qᵀr and the
/// Jacobian R have the same cost, gradient and Gauss-Newton matrix in a handful of rows.
class CompressedCost : public ceres::CostFunction {
 public:
  CompressedCost(const CaseModel& model, const Hypothesis& start, const FitOptions& options)
      : model_(model), hypothesis_(start), options_(options), p_(start.free.size()) {
    set_num_residuals(static_cast<int>(p_) + 1 + static_cast<int>(p_));  // data, then priors
    mutable_parameter_block_sizes()->push_back(static_cast<int>(p_));
    fitted_.resize(static_cast<Index>(model.size()));
    double n = 0;
    for (const Target& t : model.targets()) {
      const double w = Counts(model, t, Which::kFit) ? 1 : 0;
      fitted_.segment(static_cast<Index>(t.first), static_cast<Index>(t.count)).setConstant(w);
      n += w * static_cast<double>(t.count);
    }
    weight_ = std::sqrt(options.effective / std::max(n, 1.0));
    for (std::size_t k = 0; k < p_; ++k)
      if (start.free[k].effect < 0) base_.push_back(k);
      else effect_.push_back(k);
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
    const Eigen::Map<const Eigen::VectorXd> full(r.data(), static_cast<Index>(r.size()));
    const Eigen::VectorXd data = weight_ * full.cwiseProduct(fitted_);
    std::fill_n(residuals, num_residuals(), 0.0);
    for (std::size_t k = 0; k < p_; ++k)
      residuals[p_ + 1 + k] = hypothesis_.free[k].sd > 0 ? x[0][k] : 0;
    if (!jacobians || !jacobians[0]) {
      residuals[0] = data.norm();
      return true;
    }
    const Eigen::MatrixXd J = FullJacobian(h, *predicted);
    Eigen::MatrixXd gram(static_cast<Index>(p_) + 1, static_cast<Index>(p_) + 1);
    const Eigen::MatrixXd weighted = -weight_ * (fitted_.asDiagonal() * J);
    gram.topLeftCorner(J.cols(), J.cols()).noalias() = weighted.transpose() * weighted;
    gram.topRightCorner(J.cols(), 1).noalias() = weighted.transpose() * data;
    gram.bottomLeftCorner(1, J.cols()) = gram.topRightCorner(J.cols(), 1).transpose();
    gram(J.cols(), J.cols()) = data.squaredNorm();
    gram.diagonal().array() += 1e-12 * gram.diagonal().array().abs() + 1e-14;
    const Eigen::MatrixXd R = gram.llt().matrixU();
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> out(
        jacobians[0], num_residuals(), static_cast<Index>(p_));
    out.setZero();
    out.topRows(static_cast<Index>(p_) + 1) = R.leftCols(static_cast<Index>(p_));
    for (std::size_t k = 0; k <= p_; ++k) residuals[k] = R(static_cast<Index>(k), static_cast<Index>(p_));
    for (std::size_t k = 0; k < p_; ++k)
      if (hypothesis_.free[k].sd > 0) out(static_cast<Index>(p_ + 1 + k), static_cast<Index>(k)) = 1;
    return true;
  }

  /// Columns of all parameters; those of the rig are computed once, those of effects here.
  Eigen::MatrixXd FullJacobian(const Hypothesis& h, const std::vector<double>& predicted) const {
    Eigen::MatrixXd J(static_cast<Index>(model_.size()), static_cast<Index>(p_));
    if (base_jacobian_.size() == 0) {
      if (options_.base_jacobian)
        base_jacobian_ = options_.base_jacobian->leftCols(static_cast<Index>(base_.size()));
      else
        base_jacobian_ = Jacobian(model_, h, predicted, base_);
    }
    for (std::size_t k = 0; k < base_.size(); ++k) J.col(static_cast<Index>(base_[k])) = base_jacobian_.col(static_cast<Index>(k));
    const Eigen::MatrixXd moving = Jacobian(model_, h, predicted, effect_, 0.1);
    for (std::size_t k = 0; k < effect_.size(); ++k) J.col(static_cast<Index>(effect_[k])) = moving.col(static_cast<Index>(k));
    return J;
  }

  double weight() const { return weight_; }
  const Eigen::VectorXd& fitted() const { return fitted_; }

 private:
  const CaseModel& model_;
  const Hypothesis hypothesis_;
  const FitOptions& options_;
  std::size_t p_;
  Eigen::VectorXd fitted_;  // 1 for rows of fit records
  double weight_ = 1;
  std::vector<std::size_t> base_, effect_;
  mutable Eigen::MatrixXd base_jacobian_;
};

/// Covariance of the optimum and what a user should know about it.
void Judge(const CompressedCost& cost, FitResult& result) {
  Hypothesis& h = result.hypothesis;
  const std::size_t p = h.free.size();
  result.jacobian = cost.FullJacobian(h, result.predicted);
  const Eigen::MatrixXd J = cost.weight() * (cost.fitted().asDiagonal() * result.jacobian);
  Eigen::MatrixXd information = J.transpose() * J;
  result.sd.assign(p, 0);
  // A law that differs from the truth leaves more than noise: the parameters are that much less sure.
  const double inflation = std::max(1.0, result.ratio_fit);
  Eigen::VectorXd influence = information.diagonal().cwiseSqrt();
  for (std::size_t k = 0; k < p; ++k)
    information(static_cast<Index>(k), static_cast<Index>(k)) += h.free[k].sd > 0 ? 1.0 : 1e-9;
  const Eigen::MatrixXd covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  for (std::size_t k = 0; k < p; ++k) {
    const auto i = static_cast<Index>(k);
    const FreeParameter& f = h.free[k];
    const double unit = f.logarithmic ? 0.3 * f.value : f.step;
    result.sd[k] = inflation * unit * std::sqrt(std::max(0.0, covariance(i, i)));
    if (f.effect < 0) continue;
    if (influence(i) < 1e-6) result.warnings.push_back(f.path + " has no influence on these records");
    if (f.value <= f.lo || f.value >= f.hi) result.warnings.push_back(fmt::format("{} is at its bound {}", f.path, f.value));
    for (std::size_t m = 0; m < p; ++m) {
      const auto j = static_cast<Index>(m);
      const double c = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      if (m != k && std::abs(c) > 0.97) result.warnings.push_back(fmt::format("{} and {} are correlated by {:.3f}", f.path, h.free[m].path, c));
    }
  }
}

}  // namespace

FitResult Fit(const CaseModel& model, const Hypothesis& start, const FitOptions& options) {
  FitResult result;
  result.hypothesis = start;
  auto* cost = new CompressedCost(model, start, options);  // owned by the problem
  ceres::Problem problem;
  std::vector<double> x(start.free.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = start.Coordinate(k);
  ceres::Solver::Summary summary;
  if (!x.empty()) {
    problem.AddResidualBlock(cost, nullptr, x.data());
    for (std::size_t k = 0; k < x.size(); ++k) {
      const FreeParameter& f = start.free[k];
      const auto bound = [&](double v) { return f.logarithmic ? std::log(std::max(v, 1e-300) / f.start) / 0.3 : (v - f.start) / f.step; };
      if (std::isfinite(f.lo)) problem.SetParameterLowerBound(x.data(), static_cast<int>(k), std::min(bound(f.lo), x[k]));
      if (std::isfinite(f.hi)) problem.SetParameterUpperBound(x.data(), static_cast<int>(k), std::max(bound(f.hi), x[k]));
    }
    ceres::Solver::Options solver;
    solver.max_num_iterations = options.iterations;
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.function_tolerance = 3e-4;
    solver.parameter_tolerance = 1e-4;
    solver.gradient_tolerance = 1e-12;
    solver.initial_trust_region_radius = 1e3;
    solver.logging_type = ceres::SILENT;
    solver.max_num_consecutive_invalid_steps = 4;
    ceres::Solve(solver, &problem, &summary);
    result.hypothesis = cost->At(x.data());
  }
  const auto predicted = model.Predict(result.hypothesis);
  if (!predicted) {
    result.warnings.push_back("the model does not hold its rotor at this point");
    result.ratio_fit = result.ratio_validate = kInfinity;
    if (x.empty()) delete cost;
    return result;
  }
  result.predicted = *predicted;
  result.residual = Residual(model, result.predicted);
  result.ratio_fit = Ratio(model, result.residual, Which::kFit);
  result.ratio_validate = Ratio(model, result.residual, Which::kValidate);
  if (result.ratio_validate == 0) result.ratio_validate = result.ratio_fit;
  result.converged = x.empty() || summary.IsSolutionUsable();
  if (!x.empty()) {
    Judge(*cost, result);
  } else {
    delete cost;
  }
  return result;
}

}  // namespace ambrig
