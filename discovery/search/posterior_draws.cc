#include "discovery/search/posterior_draws.h"

#include "core/math/noise.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

std::vector<Hypothesis> PosteriorDraws(const CaseModel& model, const FitResult& fit,
                                       double effective_sample_size, int count) {
  constexpr std::uint64_t kSeed = 1;
  constexpr std::uint32_t kStream = 301;
  const auto p = static_cast<Eigen::Index>(fit.hypothesis.free.size());
  Eigen::MatrixXd information =
      FitGram(model, FittedRecords(model, {}), fit.jacobian, fit.residual).topLeftCorner(p, p);
  information *= RowWeight(model, fit.ratio_fit, effective_sample_size);
  AddPriorInformation(fit.hypothesis, information);
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  std::vector<Hypothesis> out;
  for (int n = 0; n < count && factor.info() == Eigen::Success; ++n) {
    Eigen::VectorXd z(p);
    for (Eigen::Index k = 0; k < p; ++k)
      z(k) = Normal(kSeed, kStream, static_cast<std::uint64_t>(n * p + k));
    const Eigen::VectorXd step = factor.matrixU().solve(z);
    Hypothesis h = fit.hypothesis;
    for (Eigen::Index k = 0; k < p; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double value = h.ValueAt(i, h.Coordinate(i) + step(k));
      h.Set(i, std::clamp(value, h.free[i].lo, h.free[i].hi));
    }
    out.push_back(std::move(h));
  }
  return out;
}

}  // namespace ambrig
