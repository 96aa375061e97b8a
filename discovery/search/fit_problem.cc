#include "discovery/search/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "discovery/model/residual.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/likelihood.h"
#include "discovery/search/rig_prior.h"
#include "discovery/search/whole_periods.h"

namespace ambrig {

namespace {

// Steps of the differences. A prediction jumps by some hundredths of the floor where a switching
// edge passes a sample: a small step would divide that by little. Frequencies are known to a
// fraction of 1/duration.
constexpr double kRigStep = 1;            // of a rig parameter's sd
constexpr double kEffectStep = 0.1;       // of a parameter's natural step
constexpr double kFrequencyStep = 0.01;   // of the same, of effects that have a frequency
constexpr double kSensitivitiesHold = 1;  // sd of a rig parameter
// Part of the squared change of the errors that the sensitivities did not tell, beside the jumps of
// a prediction (squared, a row): above it they are taken anew, below it corrected by the step
// itself.
constexpr double kUntold = 0.25;
constexpr double kJumps = 0.005;

bool HasFrequency(const Hypothesis& h, const FreeParameter& p) {
  const EffectInstance& e = h.rig.effects[static_cast<std::size_t>(p.effect)];
  return std::any_of(e.table.begin(), e.table.end(),
                     [](const EffectParameter& row) { return row.name == "frequency"; });
}

/// Whether sensitivities of so many columns were lent: a fit that lost the rotor has none to lend.
bool Lends(const FitOptions& options, const CaseModel& model, std::size_t columns) {
  return options.base_jacobian &&
         options.base_jacobian->rows() == static_cast<Eigen::Index>(model.size()) &&
         options.base_jacobian->cols() >= static_cast<Eigen::Index>(columns);
}

}  // namespace

FitProblem::FitProblem(const CaseModel& model, const Hypothesis& start, const FitOptions& options)
    : model_(model),
      hypothesis_(start),
      options_(options),
      look_(FittedRecords(model, options)),
      p_(start.free.size()),
      base_at_(start) {
  const bool lends = Lends(options, model, options.lent);
  for (std::size_t k = 0; k < p_; ++k) {
    const bool steps = WholePeriodOf(model, start, start.free[k]) > 0;
    if (steps) stepped_.push_back(k);
    if (start.free[k].effect < 0 || (lends && k < options.lent))
      base_.push_back(k);
    else if (!steps)
      (HasFrequency(start, start.free[k]) ? tuned_ : effect_).push_back(k);
  }
  reuse_ = Lends(options, model, base_.size());
}

void FitProblem::SetMisfitWeight(double ratio) {
  weight_ = std::sqrt(RowWeight(model_, ratio, options_.effective_sample_size));
}

double FitProblem::MisfitBetween(double before, double after) const {
  double rows = 0;
  for (const Target& t : model_.targets())
    if (look_.records[t.record]) rows += CountedRows(model_, t);
  return weight_ * weight_ * rows * (before * before - after * after);
}

Eigen::MatrixXd FitProblem::Information(const Eigen::MatrixXd& jacobian) const {
  const double per_number = weight_ * weight_ *
                            static_cast<double>(std::max<std::size_t>(1, model_.size())) /
                            options_.effective_sample_size;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  for (const Target& t : model_.targets()) {
    if (!look_.records[t.record]) continue;
    const auto rows =
        jacobian.middleRows(static_cast<Eigen::Index>(t.first), static_cast<Eigen::Index>(t.count));
    const double weight = t.independent > 0 ? per_number * t.independent : weight_ * weight_;
    sum.noalias() += weight * (rows.transpose() * rows);
  }
  return sum;
}

void FitProblem::Refresh() {
  base_jacobian_.resize(0, 0);
  jacobian_.resize(0, 0);
  reuse_ = false;
}

bool FitProblem::OutsideOfSensitivities(const Hypothesis& h) const {
  return std::any_of(base_.begin(), base_.end(), [&](std::size_t k) {
    return std::abs(h.Coordinate(k) - base_at_.Coordinate(k)) > kSensitivitiesHold;
  });
}

Hypothesis FitProblem::At(const double* x) const {
  Hypothesis h = hypothesis_;
  for (std::size_t k = 0; k < p_; ++k) h.Set(k, h.ValueAt(k, x[k]));
  return h;
}

bool FitProblem::Evaluate(double const* const* x, double* residuals, double** jacobians) const {
  const Hypothesis h = At(x[0]);
  const auto predicted = model_.PredictAll({h}, ModelFidelity::kAsSampled, &look_)[0];
  if (!predicted) return false;
  const std::vector<double> r = Residual(model_, *predicted, &look_);
  std::fill_n(residuals, num_residuals(), 0.0);
  for (std::size_t k = 0; k < p_; ++k)
    residuals[p_ + 1 + k] = hypothesis_.free[k].sd > 0 ? PriorResidual(x[0][k]) : 0;
  if (!jacobians || !jacobians[0]) {
    residuals[0] =
        std::sqrt(FitGram(model_, look_, Eigen::MatrixXd(r.size(), 0), r)(0, 0)) * weight_;
    return true;
  }
  if (!CorrectBySecant(x[0], r)) jacobian_ = FitJacobian(h);
  at_.assign(x[0], x[0] + p_);
  residual_ = r;
  Eigen::MatrixXd gram = weight_ * weight_ * FitGram(model_, look_, jacobian_, r);
  // a prediction that rises lowers the residual
  gram.topRightCorner(static_cast<Eigen::Index>(p_), 1) *= -1;
  gram.bottomLeftCorner(1, static_cast<Eigen::Index>(p_)) *= -1;
  gram.diagonal().array() += 1e-12 * gram.diagonal().array().abs() + 1e-14;
  const Eigen::MatrixXd R = gram.llt().matrixU();
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> out(
      jacobians[0], num_residuals(), static_cast<Eigen::Index>(p_));
  out.setZero();
  out.topRows(static_cast<Eigen::Index>(p_) + 1) = R.leftCols(static_cast<Eigen::Index>(p_));
  for (std::size_t k = 0; k <= p_; ++k)
    residuals[k] = R(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(p_));
  for (std::size_t k = 0; k < p_; ++k)
    if (hypothesis_.free[k].sd > 0)
      out(static_cast<Eigen::Index>(p_ + 1 + k), static_cast<Eigen::Index>(k)) =
          PriorSlope(x[0][k]);
  HoldAtBounds(x[0], residuals, out);
  return true;
}

Eigen::MatrixXd FitProblem::FitJacobian(const Hypothesis& h) const {
  if (base_jacobian_.size() == 0) {
    if (reuse_)
      base_jacobian_ = options_.base_jacobian->leftCols(static_cast<Eigen::Index>(base_.size()));
    else
      base_jacobian_ = Jacobian(model_, h, base_, kRigStep, &look_, options_.differences);
    base_at_ = h;
  }
  return Joined(base_jacobian_, h, &look_);
}

Eigen::MatrixXd FitProblem::FullJacobian(const Hypothesis& h) const {
  const bool whole = base_jacobian_.size() == 0 || !reuse_;
  if (base_jacobian_.size() == 0) base_at_ = h;
  return Joined(whole ? Jacobian(model_, base_at_, base_, kRigStep, nullptr, options_.differences)
                      : base_jacobian_,
                h, nullptr);
}

bool FitProblem::CorrectBySecant(const double* x, const std::vector<double>& r) const {
  if (jacobian_.size() == 0 || !tuned_.empty() ||
      options_.differences == DifferenceSides::kTwoSided)
    return false;
  const auto n = static_cast<Eigen::Index>(p_);
  const Eigen::VectorXd step =
      Eigen::Map<const Eigen::VectorXd>(x, n) - Eigen::Map<const Eigen::VectorXd>(at_.data(), n);
  if (step.squaredNorm() == 0) return true;
  Eigen::VectorXd untold = Eigen::VectorXd::Zero(jacobian_.rows());
  double told = 0, rows = 0;
  for (const Target& t : model_.targets()) {
    if (!look_.records[t.record]) continue;
    const auto first = static_cast<Eigen::Index>(t.first),
               count = static_cast<Eigen::Index>(t.count);
    const auto part = [&](const std::vector<double>& all) {
      return Eigen::Map<const Eigen::VectorXd>(all.data() + first, count);
    };
    const Eigen::VectorXd said = jacobian_.middleRows(first, count) * step;
    told += said.squaredNorm();
    rows += static_cast<double>(count);
    untold.segment(first, count) = part(r) - part(residual_) + said;
  }
  if (untold.squaredNorm() > kUntold * told + kJumps * rows) return false;
  // a prediction that rises lowers the residual
  jacobian_.noalias() -= untold * step.transpose() / step.squaredNorm();
  return true;
}

double FitProblem::BoundOf(std::size_t k, double value) const {
  if (!std::isfinite(value)) return value;
  return hypothesis_.CoordinateOf(
      k, hypothesis_.free[k].logarithmic ? std::max(value, 1e-300) : value);
}

void FitProblem::HoldAtBounds(
    const double* x, const double* residuals,
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& jacobian)
    const {
  const Eigen::Map<const Eigen::VectorXd> r(residuals, jacobian.rows());
  for (std::size_t k = 0; k < p_; ++k) {
    const double slope = jacobian.col(static_cast<Eigen::Index>(k)).dot(r);
    if ((x[k] <= LowerBound(k) && slope > 0) || (x[k] >= UpperBound(k) && slope < 0))
      jacobian.col(static_cast<Eigen::Index>(k)).setZero();
  }
}

Eigen::MatrixXd FitProblem::Joined(const Eigen::MatrixXd& of_rig, const Hypothesis& h,
                                   const RecordSubset* look) const {
  Eigen::MatrixXd J(static_cast<Eigen::Index>(model_.size()), static_cast<Eigen::Index>(p_));
  const auto put = [&J](const std::vector<std::size_t>& at, const Eigen::MatrixXd& columns) {
    for (std::size_t k = 0; k < at.size(); ++k)
      J.col(static_cast<Eigen::Index>(at[k])) = columns.col(static_cast<Eigen::Index>(k));
  };
  put(base_, of_rig);
  if (!effect_.empty())
    put(effect_, Jacobian(model_, h, effect_, kEffectStep, look, options_.differences));
  if (!tuned_.empty())
    put(tuned_, Jacobian(model_, h, tuned_, kFrequencyStep, look, options_.differences));
  for (const std::size_t k : stepped_) J.col(static_cast<Eigen::Index>(k)).setZero();
  return J;
}

}  // namespace ambrig
