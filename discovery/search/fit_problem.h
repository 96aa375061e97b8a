#pragma once
/// The least-squares problem of a fit, without its solver. Internal to discovery.

#include <algorithm>
#include <cmath>

#include "discovery/decision/likelihood.h"
#include "discovery/model/jacobian.h"
#include "discovery/search/fit.h"

namespace ambrig {

// Steps of the differences. A prediction jumps by some hundredths of the floor where a switching edge
// passes a sample: a small step would divide that by little. Frequencies are known to a fraction of 1/duration.
inline constexpr double kRigStep = 1;            // of a rig parameter's sd
inline constexpr double kEffectStep = 0.1;       // of a parameter's natural step
inline constexpr double kFrequencyStep = 0.01;   // of the same, of effects that have a frequency
inline constexpr double kBelieved = 3;           // sd of a rig parameter within its tolerance
inline constexpr double kBeyond = 5;             // each further sd counts as so many
inline constexpr double kSensitivitiesHold = 1;  // sd of a rig parameter
// Part of the squared change of the errors that the sensitivities did not tell, beside the jumps of a prediction
// (squared, a row): above it they are taken anew, below it corrected by the step itself.
inline constexpr double kUntold = 0.25;
inline constexpr double kJumps = 0.005;

/// The prior's residual of a rig parameter that stands `sds` from its mean, and its slope. Gaussian
/// within three sd; a part further off is hardly the part of the drawing, and an effect that is
/// missing must not be paid with it.
inline double PriorResidual(double sds) {
  return sds + std::copysign((kBeyond - 1) * std::max(0.0, std::abs(sds) - kBelieved), sds);
}
inline double PriorSlope(double sds) { return std::abs(sds) > kBelieved ? kBeyond : 1; }
/// Σ of their squares over the rig parameters of `h`.
inline double PriorPenalty(const Hypothesis& h) {
  double sum = 0;
  for (std::size_t k = 0; k < h.free.size(); ++k)
    if (h.free[k].sd > 0) sum += std::pow(PriorResidual(h.Coordinate(k)), 2);
  return sum;
}

/// The fitted records, or those of them that the options name: unseen ones are simulated at the end.
inline QuickLook FittedRecords(const CaseModel& model, const FitOptions& options) {
  const std::vector<CaseRecord>& records = model.data().records;
  QuickLook look{std::vector<char>(records.size(), 0), std::vector<double>(model.size(), 0.0)};
  for (std::size_t r = 0; r < records.size(); ++r)
    look.records[r] = !records[r].validate && (options.records.empty() || options.records[r]);
  return look;
}

/// [J r]ᵀ[J r] over the rows of the fit records looked at.
inline Eigen::MatrixXd FitGram(const CaseModel& model, const QuickLook& look,
                               const Eigen::MatrixXd& J, const std::vector<double>& r) {
  const Eigen::Index p = J.cols();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p + 1, p + 1);
  for (const Target& t : model.targets()) {
    if (!look.records[t.record]) continue;
    const auto rows =
        J.middleRows(static_cast<Eigen::Index>(t.first), static_cast<Eigen::Index>(t.count));
    const Eigen::Map<const Eigen::VectorXd> part(r.data() + t.first,
                                                 static_cast<Eigen::Index>(t.count));
    gram.topLeftCorner(p, p).noalias() += rows.transpose() * rows;
    gram.topRightCorner(p, 1).noalias() += rows.transpose() * part;
    gram(p, p) += part.squaredNorm();
  }
  gram.bottomLeftCorner(1, p) = gram.topRightCorner(p, 1).transpose();
  return gram;
}

/// The least-squares problem seen through its Gram matrix: with [J r] = Q R the residual Qᵀr and
/// the Jacobian R have the same cost, gradient and Gauss-Newton matrix in a handful of rows.
class FitProblem {
 public:
  FitProblem(const CaseModel& model, const Hypothesis& start, const FitOptions& options)
      : model_(model),
        hypothesis_(start),
        options_(options),
        look_(FittedRecords(model, options)),
        p_(start.free.size()),
        base_at_(start) {
    for (std::size_t k = 0; k < p_; ++k)
      if (start.free[k].effect < 0 || (options.base_jacobian && k < options.lent))
        base_.push_back(k);
      else
        (HasFrequency(start, start.free[k]) ? tuned_ : effect_).push_back(k);
  }

  /// Weight of a residual when the model leaves `ratio` times the noise.
  void SetMisfitWeight(double ratio) {
    weight_ = std::sqrt(RowWeight(model_, ratio, options_.effective_sample_size));
  }
  /// What 2 log likelihood of the rows looked at rises by from one ratio to a smaller one, at the weight set.
  double MisfitBetween(double before, double after) const {
    double rows = 0;
    for (const Target& t : model_.targets())
      if (look_.records[t.record])
        rows += static_cast<double>(
            std::count(model_.ok().begin() + static_cast<std::ptrdiff_t>(t.first),
                       model_.ok().begin() + static_cast<std::ptrdiff_t>(t.first + t.count), 1));
    return weight_ * weight_ * rows * (before * before - after * after);
  }
  /// Sensitivities of the rig parameters are taken anew.
  void Refresh() {
    base_jacobian_.resize(0, 0);
    jacobian_.resize(0, 0);
    reuse_ = false;
  }
  /// Whether a rig parameter of `h` lies beyond the neighbourhood of the point where the sensitivities
  /// of the rig parameters were taken.
  bool OutsideOfSensitivities(const Hypothesis& h) const {
    return std::any_of(base_.begin(), base_.end(), [&](std::size_t k) {
      return std::abs(h.Coordinate(k) - base_at_.Coordinate(k)) > kSensitivitiesHold;
    });
  }

  Hypothesis At(const double* x) const {
    Hypothesis h = hypothesis_;
    for (std::size_t k = 0; k < p_; ++k) h.Set(k, h.ValueAt(k, x[k]));
    return h;
  }

  /// Bounds of a parameter's coordinate.
  double LowerBound(std::size_t k) const { return BoundOf(k, hypothesis_.free[k].lo); }
  double UpperBound(std::size_t k) const { return BoundOf(k, hypothesis_.free[k].hi); }

  int parameters() const { return static_cast<int>(p_); }
  int num_residuals() const { return 2 * static_cast<int>(p_) + 1; }  // data, then priors

  /// As ceres::CostFunction::Evaluate.
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const {
    const Hypothesis h = At(x[0]);
    const auto predicted = model_.PredictAll({h}, ModelFidelity::kAsSampled, &look_)[0];
    if (!predicted) return false;
    const std::vector<double> r = Residual(model_, *predicted);
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

  /// Columns of all parameters on the records looked at; those of the rig are computed once a pass,
  /// those of effects here.
  Eigen::MatrixXd FitJacobian(const Hypothesis& h) const {
    if (base_jacobian_.size() == 0) {
      if (reuse_)
        base_jacobian_ = options_.base_jacobian->leftCols(static_cast<Eigen::Index>(base_.size()));
      else
        base_jacobian_ = Jacobian(model_, h, base_, kRigStep, &look_, options_.differences);
      base_at_ = h;
    }
    return Joined(base_jacobian_, h, &look_);
  }

  /// The same on all records: the rig's where the last pass took them (in memory for what it looked at).
  Eigen::MatrixXd FullJacobian(const Hypothesis& h) const {
    const bool whole = base_jacobian_.size() == 0 || !reuse_;
    if (base_jacobian_.size() == 0) base_at_ = h;
    return Joined(whole ? Jacobian(model_, base_at_, base_, kRigStep, nullptr, options_.differences)
                        : base_jacobian_,
                  h, nullptr);
  }

  double weight() const { return weight_; }
  const CaseModel& model() const { return model_; }
  const QuickLook& look() const { return look_; }

 private:
  /// Broyden's rank-one correction of the sensitivities by the step from where they were last used: they then
  /// tell the change of the residual to `r` exactly. Besides saving simulations it takes away what the jumps of
  /// the predictions add to small differences, which makes steps too small. false: they told too little of the
  /// change to go on with. Source: Nocedal and Wright, "Numerical Optimization", 2nd ed., 11.1.
  bool CorrectBySecant(const double* x, const std::vector<double>& r) const {
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

  double BoundOf(std::size_t k, double value) const {
    if (!std::isfinite(value)) return value;
    return hypothesis_.CoordinateOf(
        k, hypothesis_.free[k].logarithmic ? std::max(value, 1e-300) : value);
  }

  /// A parameter at a bound which the slope of the cost pushes against is held there: its column is zero. Ceres
  /// projects steps into the bounds only after it has computed them, and the other parameters would go with one
  /// that cannot move. Source: D. P. Bertsekas, SIAM J. Control Optim. 20 (1982), projected Newton.
  template <class Matrix>
  void HoldAtBounds(const double* x, const double* residuals, Matrix& out) const {
    const Eigen::Map<const Eigen::VectorXd> r(residuals, out.rows());
    for (std::size_t k = 0; k < p_; ++k) {
      const double slope = out.col(static_cast<Eigen::Index>(k)).dot(r);
      if ((x[k] <= LowerBound(k) && slope > 0) || (x[k] >= UpperBound(k) && slope < 0))
        out.col(static_cast<Eigen::Index>(k)).setZero();
    }
  }

  static bool HasFrequency(const Hypothesis& h, const FreeParameter& p) {
    const EffectInstance& e = h.rig.effects[static_cast<std::size_t>(p.effect)];
    return std::any_of(e.table.begin(), e.table.end(),
                       [](const EffectParameter& row) { return row.name == "frequency"; });
  }
  /// The columns of the rig beside those of the effects at `h`.
  Eigen::MatrixXd Joined(const Eigen::MatrixXd& of_rig, const Hypothesis& h,
                         const QuickLook* look) const {
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
    return J;
  }

  const CaseModel& model_;
  const Hypothesis hypothesis_;
  const FitOptions& options_;
  const QuickLook look_;
  std::size_t p_;
  double weight_ = 1;
  std::vector<std::size_t> base_, effect_, tuned_;  // tuned: of effects that have a frequency
  bool reuse_ = options_.base_jacobian != nullptr;
  mutable Eigen::MatrixXd base_jacobian_;
  mutable Hypothesis base_at_;  // where it was taken
  // of all parameters, and where they were last used with what residual
  mutable Eigen::MatrixXd jacobian_;
  mutable std::vector<double> at_, residual_;
};

}  // namespace ambrig
