#pragma once
/// Hypotheses that the records allow as well as a fit: sampled from its posterior.
#include <vector>

#include "discovery/search/fit.h"

namespace ambrig {

/// `count` draws about `fit`, which has its sensitivities: normal, with the covariance of its
/// linearised posterior (likelihood.h), within the bounds of the parameters. The same draws for the
/// same fit.
std::vector<Hypothesis> PosteriorDraws(const CaseModel& model, const FitResult& fit,
                                       double effective_sample_size, int count);

}  // namespace ambrig
