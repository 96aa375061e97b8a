#pragma once
/// Rig parameters that a fit left far from their nominal values although other parameters would
/// take their place: a longer gap and a longer iron path are the same thing to the records, and
/// only the nominal values tell them apart. Sensitivities are differences that err by a few
/// percent; where two of them cancel, that error looks like information and holds a fit where it
/// stands.
#include "discovery/search/fit.h"

namespace ambrig {

/// `fit` (with its sensitivities), or what is better by the posterior: each rig parameter beyond 2
/// sd is put back to its nominal value, or half of the way, one parameter of an effect that acts
/// much like it taking its place, and the point is simulated. The point returned has no new
/// sensitivities; `moved` says whether there is one.
struct PulledBack {
  FitResult fit;
  bool moved = false;
};
PulledBack PullBack(const CaseModel& model, const FitResult& fit, double effective_sample_size);

}  // namespace ambrig
