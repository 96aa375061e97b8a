#include "discovery/candidate_fit.h"

#include "discovery/likelihood.h"

namespace ambrig {

namespace {

/// A start that the plant refuses (a second mode of a kind, say) is no candidate.
FitResult TryFit(const CaseModel& model, const Hypothesis& h, const FitOptions& options) {
  try {
    return Fit(model, h, options);
  } catch (const InputError&) {
    FitResult refused;
    refused.ratio_fit = refused.ratio_validate = kInfinity;
    return refused;
  }
}

}  // namespace

FitResult FitBriefly(const CaseModel& model, const FitResult& now, const Candidate& candidate, double effective) {
  FitOptions brief;
  brief.effective = effective;
  brief.base_jacobian = &now.jacobian;
  brief.iterations = candidate.narrow ? 12 : 4;
  brief.passes = 1;
  brief.sensitivities = false;
  std::vector<EffectInstance> starts = {candidate.effect};
  starts.insert(starts.end(), candidate.other_starts.begin(), candidate.other_starts.end());
  FitResult best;
  double best_score = kInfinity;
  for (const EffectInstance& start : starts) {
    Hypothesis h = now.hypothesis;
    h.AddEffect(start);
    FitResult fit = TryFit(model, h, brief);
    if (!fit.converged || Score(model, fit, effective) >= best_score) continue;
    best_score = Score(model, fit, effective);
    best = std::move(fit);
    if (best.ratio_fit * best.ratio_fit - 1 < 0.5 * (now.ratio_fit * now.ratio_fit - 1)) break;  // found its way
  }
  if (!best.converged) best.ratio_fit = best.ratio_validate = kInfinity;
  return best;
}

FitResult FitOn(const CaseModel& model, const FitResult& now, const Hypothesis& start, double effective) {
  FitOptions full;
  full.effective = effective;
  full.base_jacobian = &now.jacobian;
  return TryFit(model, start, full);
}

}  // namespace ambrig
