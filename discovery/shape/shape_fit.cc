#include "discovery/shape/shape_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/box_solver.h"
#include "core/math/linear_equations.h"
#include "discovery/model/jacobian.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/likelihood.h"
#include "discovery/search/rig_prior.h"
#include "discovery/search/signature_bank.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr int kIterations = 6;
constexpr double kOfRigSd = 0.3;     // of an sd, for sensitivities of the rig parameters
constexpr double kDifference = 0.1;  // of a step, for sensitivities of the sizes
constexpr double kSpread = 10;       // prior sd of a size, in steps: the roughness is the prior
constexpr double kEnough = 1e-3;     // relative fall of the cost that ends the iteration

/// Gauss-Newton about one point, in coordinates (steps).
class ShapeProblem {
 public:
  ShapeProblem(const CaseModel& model, const Hypothesis& base, const Shape& shape,
               const ShapeFitOptions& options)
      : model_(model),
        shape_(shape),
        n_(options.effective_sample_size),
        look_(FittedRecords(model, FitOptions())) {
    now_.hypothesis = base;
    first_ = static_cast<Index>(base.free.size());
    if (options.base_jacobian && options.base_jacobian->cols() == first_)
      rig_ = *options.base_jacobian;
    AddShape();
    all_ = static_cast<Index>(now_.hypothesis.free.size());
  }

  bool Evaluate(FitResult& at) const {
    const auto predicted = model_.Predict(at.hypothesis);
    if (!predicted) return false;
    at.predicted = *predicted;
    at.residual = Residual(model_, at.predicted);
    at.ratio_fit = Ratio(model_, at.residual, Which::kFit);
    at.ratio_validate = Ratio(model_, at.residual, Which::kValidate);
    if (at.ratio_validate == 0) at.ratio_validate = at.ratio_fit;
    at.penalty = PriorPenalty(at.hypothesis);
    at.converged = true;
    return true;
  }

  /// Sensitivities; the rig parameters' are kept from the first time on unless `fresh`.
  void Linearise(bool fresh) {
    Eigen::MatrixXd columns(static_cast<Index>(model_.size()), all_ + 1);
    if (rig_.size() == 0 || fresh) {
      std::vector<std::size_t> own;
      for (Index k = 0; k < first_; ++k) own.push_back(static_cast<std::size_t>(k));
      rig_ = Jacobian(model_, now_.hypothesis, own, kOfRigSd, &look_);
    }
    std::vector<std::size_t> sizes;
    for (Index k = first_; k < all_; ++k) sizes.push_back(static_cast<std::size_t>(k));
    columns.leftCols(first_) = rig_;
    columns.middleCols(first_, all_ - first_) =
        Jacobian(model_, now_.hypothesis, sizes, kDifference, &look_);
    columns.col(all_) =
        Eigen::Map<const Eigen::VectorXd>(now_.residual.data(), static_cast<Index>(model_.size()));
    gram_ = RowProducts(model_, columns, columns).fit;
    weight_ = RowWeight(model_, now_.ratio_fit, n_);
  }

  /// Inverse prior covariance of all coordinates at a smoothing.
  Eigen::MatrixXd Penalty(double smoothing) const {
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(all_, all_);
    for (Index k = 0; k < first_; ++k)
      P(k, k) = now_.hypothesis.free[static_cast<std::size_t>(k)].sd > 0 ? 1 : 1e-9;
    P.bottomRightCorner(all_ - first_, all_ - first_) =
        smoothing * shape_.roughness.transpose() * shape_.roughness +
        Eigen::MatrixXd::Identity(all_ - first_, all_ - first_) / (kSpread * kSpread);
    return P;
  }

  struct Step {
    Eigen::VectorXd move;
    double smoothing = 0, evidence = -kInfinity;
  };

  /// The step of the smoothing with the largest evidence.
  Step BestStep() const {
    Step best;
    for (double e = -4; e <= 4; e += 0.5) {
      const Step s = StepOf(std::pow(10.0, e));
      if (s.evidence > best.evidence) best = s;
    }
    return best;
  }

  double Cost(const FitResult& at, double smoothing) const {
    const Eigen::VectorXd x = Coordinates(at.hypothesis);
    double sum = 0;
    for (const Target& t : model_.targets())
      if (Counts(model_, t, Which::kFit))
        for (std::size_t k = t.first; k < t.first + t.count; ++k)
          sum += at.residual[k] * at.residual[k];
    return weight_ * sum + x.dot(Penalty(smoothing) * x);
  }

  Hypothesis Moved(const Eigen::VectorXd& move, double part) const {
    Hypothesis h = now_.hypothesis;
    for (Index k = 0; k < all_; ++k) {
      const auto i = static_cast<std::size_t>(k);
      h.Set(i, h.ValueAt(i, h.Coordinate(i) + part * move(k)));
    }
    return h;
  }

  /// Covariances and influences of the sizes, about the point of the last Linearise.
  void Describe(double smoothing, ShapeFit& out) const {
    const Index m = all_ - first_;
    const Eigen::MatrixXd information = weight_ * gram_.topLeftCorner(all_, all_),
                          prior = Penalty(smoothing);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(all_, all_);
    const Eigen::VectorXd unit = shape_.step;
    const auto scaled = [&](const Eigen::MatrixXd& inverse) {
      return Eigen::MatrixXd(unit.asDiagonal() * inverse.bottomRightCorner(m, m) *
                             unit.asDiagonal());
    };
    out.posterior = scaled(SolveSymmetricColumns(information + prior, one));
    out.prior = scaled(SolveSymmetricColumns(prior, one));
    out.smoothing = smoothing;
    for (Index k = 0; k < m; ++k)
      out.influence.push_back(information(first_ + k, first_ + k) * kSpread * kSpread);
  }

  FitResult now_;

 private:
  void AddShape() {
    Hypothesis& h = now_.hypothesis;
    h.AddEffect(shape_.effect);
    std::erase_if(h.free, [&](const FreeParameter& p) {
      return p.effect == static_cast<int>(h.rig.effects.size()) - 1 &&
             std::find(shape_.rows.begin(), shape_.rows.end(), p.row) == shape_.rows.end();
    });
    for (std::size_t k = 0; k < shape_.rows.size(); ++k) {
      FreeParameter& p = h.free[static_cast<std::size_t>(first_) + k];
      p.start = 0;  // a coordinate is the size in steps
      p.step = shape_.step(static_cast<Index>(k));
      p.logarithmic = false;
    }
  }

  Eigen::VectorXd Coordinates(const Hypothesis& h) const {
    Eigen::VectorXd x(all_);
    for (Index k = 0; k < all_; ++k) x(k) = h.Coordinate(static_cast<std::size_t>(k));
    return x;
  }

  Step StepOf(double smoothing) const {
    const Eigen::MatrixXd P = Penalty(smoothing), A = weight_ * gram_.topLeftCorner(all_, all_) + P;
    const Eigen::VectorXd x = Coordinates(now_.hypothesis),
                          g = weight_ * gram_.topRightCorner(all_, 1) - P * x;
    Eigen::VectorXd lo(all_), hi(all_);
    for (Index k = 0; k < all_; ++k) {
      const FreeParameter& p = now_.hypothesis.free[static_cast<std::size_t>(k)];
      lo(k) = Limit(p, p.lo) - x(k);
      hi(k) = Limit(p, p.hi) - x(k);
    }
    Step s;
    s.smoothing = smoothing;
    s.move = SolveInBox(A, g, lo, hi);
    const double cost =
        weight_ * gram_(all_, all_) + x.dot(P * x) - 2 * g.dot(s.move) + s.move.dot(A * s.move);
    const auto determinant = [](const Eigen::MatrixXd& M) {
      return 2 * Eigen::MatrixXd(M.llt().matrixL()).diagonal().array().log().sum();
    };
    s.evidence = -cost - determinant(A) + determinant(P);
    return s;
  }

  static double Limit(const FreeParameter& p, double v) {
    if (std::isinf(v)) return v;
    return p.logarithmic ? std::log(std::max(v, 1e-300) / p.start) / 0.3 : (v - p.start) / p.step;
  }

  const CaseModel& model_;
  const Shape& shape_;
  double n_, weight_ = 1;
  const RecordSubset look_;  // at the fitted records: the sensitivities need no others
  Index first_ = 0, all_ = 0;
  Eigen::MatrixXd rig_, gram_;
};

/// Goes along the step as far as the cost falls. Returns the relative fall, 0: nowhere.
double Follow(ShapeProblem& problem, const ShapeProblem::Step& step) {
  const double before = problem.Cost(problem.now_, step.smoothing);
  for (double part = 1; part > 0.1; part *= 0.5) {
    FitResult there;
    there.hypothesis = problem.Moved(step.move, part);
    if (!problem.Evaluate(there)) continue;
    const double after = problem.Cost(there, step.smoothing);
    if (after >= before) continue;
    problem.now_ = std::move(there);
    return (before - after) / before;
  }
  return 0;
}

Eigen::VectorXd Gradient(const Shape& shape, const std::vector<double>& sizes, double u) {
  Eigen::VectorXd g(static_cast<Index>(sizes.size()));
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    std::vector<double> up = sizes, down = sizes;
    const double h = 1e-3 * shape.step(static_cast<Index>(k));
    up[k] += h;
    down[k] -= h;
    g(static_cast<Index>(k)) = (shape.value(up, u) - shape.value(down, u)) / (2 * h);
  }
  return g;
}

}  // namespace

double ShapeFit::CurveSd(const Shape& shape, double u) const {
  const Eigen::VectorXd g = Gradient(shape, sizes, u);
  return std::sqrt(std::max(0.0, g.dot(posterior * g)));
}

double ShapeFit::Support(const Shape& shape, double u) const {
  const Eigen::VectorXd g = Gradient(shape, sizes, u);
  const double before = g.dot(prior * g);
  return before > 0 ? std::clamp(1 - g.dot(posterior * g) / before, 0.0, 1.0) : 1.0;
}

ShapeFit FitShape(const CaseModel& model, const Hypothesis& base, const Shape& shape,
                  const ShapeFitOptions& options) {
  ShapeProblem problem(model, base, shape, options);
  ShapeFit out;
  if (!problem.Evaluate(problem.now_)) {
    out.fit = problem.now_;
    out.fit.ratio_fit = out.fit.ratio_validate = kInfinity;
    return out;
  }
  double smoothing = 1;
  for (; out.iterations < kIterations; ++out.iterations) {
    if (options.progress)
      options.progress(static_cast<double>(out.iterations) / kIterations,
                       fmt::format("shape, step {}", out.iterations + 1));
    problem.Linearise(out.iterations == 2 && !options.base_jacobian);
    const ShapeProblem::Step step = problem.BestStep();
    smoothing = step.smoothing;
    if (Follow(problem, step) < kEnough) break;
  }
  if (options.describe) {
    problem.Linearise(false);
    problem.Describe(smoothing, out);
  }
  out.fit = problem.now_;
  for (const std::size_t row : shape.rows)
    out.sizes.push_back(out.fit.hypothesis.rig.effects.back().values[row]);
  return out;
}

Hypothesis WithoutEffect(const Hypothesis& h, std::size_t index) {
  Hypothesis out = h;
  out.rig.effects.erase(out.rig.effects.begin() + static_cast<std::ptrdiff_t>(index));
  std::erase_if(out.free,
                [&](const FreeParameter& p) { return p.effect == static_cast<int>(index); });
  for (FreeParameter& p : out.free)
    if (p.effect > static_cast<int>(index)) --p.effect;
  return out;
}

}  // namespace ambrig
