#pragma once
/// What the linear screening promises of a candidate: whether a fit of it is worth its simulations.
#include "discovery/search/linear_judge.h"

namespace ambrig {

/// Whether the linear screening promises at least half of what adoption would ask for, on unseen
/// records or, where these hardly show the effect, much on the fitted ones.
bool Promising(const FitResult& now, const Candidate& c);

/// Whether the linear screening promises most of the error where an effect acts, however little
/// that is of what the law of an earlier effect leaves elsewhere.
bool PromisesItsChannels(const LocalShare& share);

/// Largest distance of a rig parameter from its nominal value [sd].
double LargestShift(const Hypothesis& h);

}  // namespace ambrig
