#pragma once
/// The verdict and what goes with it, from the stages of a search.
#include "discovery/decision/explanation.h"
#include "discovery/decision/unit_errors.h"

namespace ambrig {

/// Error over the noise of a fit: fitted records, unseen ones, the worst record.
StageRatios RatiosOf(const CaseModel& model, const FitResult& fit);

/// How far the rig parameters had to go, and whether those that went beyond 3 sd agree between the
/// records. A line for each of them is added to `warnings`.
ParameterNeed NeedOf(const CaseModel& model, const FitResult& fit, double effective_sample_size,
                     std::vector<std::string>& warnings);

/// Closure, remainder, probabilities and verdict. `nominal`: the rig file, `base`: rig parameters
/// alone, `last`: with all that was adopted, which stays in out.adopted when it is established.
/// `of_units`: what other units of this rig's type show (unit_errors.h).
void Conclude(const CaseModel& model, const FitResult& nominal, const FitResult& base,
              const FitResult& last, const UnitErrors& of_units, Explanation& out);

/// Verdict `data` and its set, by the faults in out.data.
void BelieveData(Explanation& out);

/// Verdict `data`: the faults that were found before any fit.
void ConcludeData(const CaseModel& model, const FitResult& nominal, Explanation& out);

}  // namespace ambrig
