#include "discovery/search/linear_step.h"

#include <algorithm>

#include "core/math/linear_equations.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

FitResult LinearlyRefitted(const CaseModel& model, const FitResult& now,
                           double effective_sample_size) {
  constexpr int kPasses = 3;  // of the weight, which follows the ratio that is left
  FitResult out = now;
  out.residual = Residual(model, now.predicted);
  out.ratio_fit = Ratio(model, out.residual, Which::kFit);
  out.ratio_validate = Ratio(model, out.residual, Which::kValidate);
  const Eigen::Index p = now.jacobian.cols();
  if (p == 0) return out;
  if (model.nuisances.any()) model.nuisances.Eliminate(out.jacobian);
  const Eigen::MatrixXd gram =
      FitGram(model, FittedRecords(model, FitOptions()), out.jacobian, out.residual);
  const Eigen::VectorXd residual = Eigen::Map<const Eigen::VectorXd>(
      out.residual.data(), static_cast<Eigen::Index>(out.residual.size()));
  for (int pass = 0; pass < kPasses; ++pass) {
    const double weight = RowWeight(model, out.ratio_fit, effective_sample_size);
    Eigen::MatrixXd A = weight * gram.topLeftCorner(p, p);
    Eigen::VectorXd b = weight * gram.topRightCorner(p, 1);
    for (Eigen::Index k = 0; k < p; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const bool prior = now.hypothesis.free[i].sd > 0;
      A(k, k) += prior ? 1 : 1e-9 * A(k, k) + 1e-12;
      if (prior) b(k) -= now.hypothesis.Coordinate(i);
    }
    const Eigen::VectorXd left = residual - out.jacobian * SolveSymmetric(A, b);
    out.residual.assign(left.data(), left.data() + left.size());
    out.ratio_fit = Ratio(model, out.residual, Which::kFit);
    out.ratio_validate = Ratio(model, out.residual, Which::kValidate);
  }
  if (out.ratio_validate == 0) out.ratio_validate = out.ratio_fit;
  return out;
}

}  // namespace ambrig
