#pragma once
/// The fit that ends a search, with fresh sensitivities of everything.
#include "discovery/search/fit.h"

namespace ambrig {

/// `found` fitted to the end, rig parameters beyond 2 sd put back where a parameter of an effect
/// takes their place (pull_back.h), with the sd under doubt (law_scatter.h) and that doubt. A fit
/// that leaves more than `found` is not taken. `effective_sample_size` as in FitOptions.
FitResult LastFit(const CaseModel& model, const FitResult& found, double effective_sample_size);

}  // namespace ambrig
