#pragma once
/// What one linear step of a fit's free parameters would explain, without a simulation.
#include "discovery/search/fit.h"

namespace ambrig {

/// `now`, whose sensitivities must be there, with the residual (over the floor, the model's
/// nuisances taken off) and the ratios that the maximum-a-posteriori step would leave if the model
/// were linear; hypothesis and predictions are those of `now`. `effective_sample_size` as in
/// FitOptions.
FitResult LinearlyRefitted(const CaseModel& model, const FitResult& now,
                           double effective_sample_size);

}  // namespace ambrig
