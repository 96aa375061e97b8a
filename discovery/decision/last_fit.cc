#include "discovery/decision/last_fit.h"

#include "discovery/decision/law_scatter.h"
#include "discovery/decision/pull_back.h"

namespace ambrig {

FitResult LastFit(const CaseModel& model, const FitResult& found, double effective_sample_size) {
  constexpr double kNoWorse = 1.0005;  // of the ratio
  FitOptions fine;
  fine.effective_sample_size = effective_sample_size;
  fine.iterations = 8;  // steps that were too long count too
  fine.passes = 4;
  fine.trust_region = 1e4;
  fine.differences = DifferenceSides::kTwoSided;
  fine.tolerance = 1e-5;
  fine.least_gain = 2;
  FitResult last = found;
  FitResult fitted = Fit(model, found.hypothesis, fine);
  if (fitted.converged && fitted.ratio_fit <= kNoWorse * found.ratio_fit) last = std::move(fitted);
  PulledBack back = PullBack(model, last, effective_sample_size);
  if (back.moved) {
    fitted = Fit(model, back.fit.hypothesis, fine);
    last = fitted.converged ? std::move(fitted) : std::move(back.fit);
  }
  const std::vector<double> of_noise = last.sd;
  last.sd = SdUnderDoubt(model, last, effective_sample_size);
  last.doubt.assign(of_noise.size(), 1);
  for (std::size_t k = 0; k < of_noise.size(); ++k)
    if (of_noise[k] > 0) last.doubt[k] = last.sd[k] / of_noise[k];
  return last;
}

}  // namespace ambrig
