#pragma once
/// Fits of an effect that the screening proposed, on top of what is believed so far.
#include "discovery/search/linear_judge.h"
#include "discovery/search/screen.h"

namespace ambrig {

/// Short fits from each of the candidate's starts; the best one, without sensitivities. Not
/// converged where no start leads anywhere.
FitResult FitBriefly(const CaseModel& model, const FitResult& now, const Candidate& candidate,
                     double effective_sample_size);

/// A short fit from a start that is nearly right (its neighbours were fitted), without
/// sensitivities. `now` as in FitOn.
FitResult FitShortly(const CaseModel& model, const FitResult& now, const Hypothesis& start,
                     double effective_sample_size);

/// What a full fit may still gain over a short one, of the score.
inline constexpr double kOpenAfterShortFit = 60;

/// The fit to the end, from what the short one found. `now` lends its sensitivities to the first
/// pass.
FitResult FitOn(const CaseModel& model, const FitResult& now, const Hypothesis& start,
                double effective_sample_size);

/// The best of the short fits of what the screening of `what` puts first: a named effect at its
/// target, or where it explains most. Not converged where nothing leads anywhere.
FitResult FitScreened(const CaseModel& model, const FitResult& base, const ScreenOptions& what);

}  // namespace ambrig
