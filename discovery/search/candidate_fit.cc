#include "discovery/search/candidate_fit.h"

#include <algorithm>

#include "discovery/decision/likelihood.h"

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

/// Size and frequency first, the damping as it was sought, then all together: a damping let loose
/// from a start beside the resonance runs up and explains a broad part of the misfit with a mode
/// that is none.
FitResult FitResonance(const CaseModel& model, const Hypothesis& start, const FitOptions& options) {
  const int effect = static_cast<int>(start.rig.effects.size()) - 1;
  Hypothesis h = start;
  std::vector<FreeParameter> held;
  std::erase_if(h.free, [&](const FreeParameter& p) {
    const bool hold = p.effect == effect && p.path.ends_with(".damping");
    if (hold) held.push_back(p);
    return hold;
  });
  FitOptions first = options;
  first.iterations = options.iterations / 2;
  FitResult fit = TryFit(model, h, first);
  if (!fit.converged) return fit;
  h = fit.hypothesis;
  h.free.insert(h.free.end(), held.begin(), held.end());
  return TryFit(model, h, options);
}

/// Whether two starts of a resonance differ in size only.
bool SameValley(const EffectInstance& a, const EffectInstance& b) {
  for (std::size_t k = 0; k < a.values.size(); ++k)
    if (a.table[k].name == "frequency" ? a.values[k] != b.values[k] : a.values[k] * b.values[k] < 0)
      return false;
  return true;
}

/// The starts of a resonance that explain most when they are simulated: the linear step knows sizes
/// and neighbouring frequencies badly where the loop answers strongly.
std::vector<EffectInstance> BestOf(const CaseModel& model, const FitResult& now,
                                   const std::vector<EffectInstance>& starts,
                                   double effective_sample_size) {
  constexpr std::size_t kFitted = 2;
  constexpr double kWorthFitting = 4;  // of the score
  std::vector<Hypothesis> all;
  for (const EffectInstance& e : starts) {
    all.push_back(now.hypothesis);
    all.back().AddEffect(e);
  }
  std::vector<std::pair<double, std::size_t>> order;
  try {
    const auto runs = model.PredictAll(all);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (!runs[k]) continue;
      const std::vector<double> residual = Residual(model, *runs[k]);
      order.emplace_back(
          Score(model, Ratio(model, residual, Which::kFit),
                Ratio(model, residual, Which::kValidate), effective_sample_size, 0, 0),
          k);
    }
  } catch (const InputError&) {
    return starts;  // refused: no start of it is any good
  }
  std::sort(order.begin(), order.end());
  std::vector<EffectInstance> out;
  // a resonance of which no start explains anything is not there
  const double here = Score(model, now.ratio_fit, now.ratio_validate, effective_sample_size, 0, 0);
  if (order.empty() || order[0].first > here - kWorthFitting) return out;
  for (const auto& [score, k] : order)
    if (out.size() < kFitted && std::none_of(out.begin(), out.end(), [&](const EffectInstance& o) {
          return SameValley(o, starts[k]);
        }))
      out.push_back(starts[k]);
  return out;
}

}  // namespace

FitResult FitBriefly(const CaseModel& model, const FitResult& now, const Candidate& candidate,
                     double effective_sample_size) {
  FitOptions brief;
  brief.effective_sample_size = effective_sample_size;
  brief.base_jacobian = &now.jacobian;
  brief.reached = now.ratio_fit;
  brief.iterations = candidate.narrow ? 12 : 4;
  brief.passes = 1;
  brief.sensitivities = false;
  std::vector<EffectInstance> starts = {candidate.effect};
  starts.insert(starts.end(), candidate.other_starts.begin(), candidate.other_starts.end());
  if (candidate.narrow) starts = BestOf(model, now, starts, effective_sample_size);
  // a wrong valley of a resonance may explain most
  const double enough = candidate.narrow ? 0.1 : 0.5;
  FitResult best;
  double best_score = kInfinity;
  for (const EffectInstance& start : starts) {
    Hypothesis h = now.hypothesis;
    h.AddEffect(start);
    FitResult fit = candidate.narrow ? FitResonance(model, h, brief) : TryFit(model, h, brief);
    if (!fit.converged || Score(model, fit, effective_sample_size) >= best_score) continue;
    best_score = Score(model, fit, effective_sample_size);
    best = std::move(fit);
    // found its way
    if (best.ratio_fit * best.ratio_fit - 1 < enough * (now.ratio_fit * now.ratio_fit - 1)) break;
  }
  if (!best.converged) best.ratio_fit = best.ratio_validate = kInfinity;
  return best;
}

FitResult FitOn(const CaseModel& model, const FitResult& now, const Hypothesis& start,
                double effective_sample_size) {
  FitOptions full;
  full.effective_sample_size = effective_sample_size;
  full.base_jacobian = &now.jacobian;
  full.reached = now.ratio_fit;
  full.iterations = 6;
  full.tolerance = 1e-4;
  return TryFit(model, start, full);
}

}  // namespace ambrig
