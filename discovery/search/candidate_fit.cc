#include "discovery/search/candidate_fit.h"

#include <algorithm>
#include <cmath>

#include "discovery/decision/likelihood.h"
#include "effects/catalogue.h"

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

/// The same resonance with `factor` times the answer, which goes with the square of its two gains or
/// with one over its mass.
EffectInstance ScaledInstance(const EffectInstance& e, double factor) {
  EffectInstance out = e;
  const EffectDescription& d = EffectNamed(e.name);
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    const EffectParameter& p = e.table[k];
    if (!d.Switches(p)) continue;
    const double scale = std::isfinite(p.null_value) ? std::sqrt(factor) : 1 / factor;
    out.values[k] = std::clamp(e.values[k] * scale, p.lo, p.hi);
  }
  return out;
}

struct SimulatedStart {
  EffectInstance effect;
  double score = kInfinity;  // infinity: the rotor is lost
};

/// What each start explains as it stands.
void Simulate(const CaseModel& model, const FitResult& now, double effective_sample_size,
              std::vector<SimulatedStart>& starts) {
  std::vector<Hypothesis> all;
  for (const SimulatedStart& s : starts) {
    all.push_back(now.hypothesis);
    all.back().AddEffect(s.effect);
  }
  const auto runs = model.PredictAll(all);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k]) continue;
    const std::vector<double> residual = Residual(model, *runs[k]);
    starts[k].score = Score(model, Ratio(model, residual, Which::kFit),
                            Ratio(model, residual, Which::kValidate), effective_sample_size, 0, 0);
  }
}

/// Neighbours of a resonance: larger, smaller, lower, higher, and with less at one of two gains.
std::vector<SimulatedStart> Neighbours(const EffectInstance& e) {
  std::vector<SimulatedStart> out = {{ScaledInstance(e, 1.6)}, {ScaledInstance(e, 0.4)}};
  const bool pair = EffectNamed(e.name).switches_pair;
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    const EffectParameter& p = e.table[k];
    const auto add = [&](double factor) {
      out.push_back({e});
      out.back().effect.values[k] = std::clamp(e.values[k] * factor, p.lo, p.hi);
    };
    if (p.name == "frequency")
      for (const double factor : {0.94, 1.06}) add(factor);
    if (pair && EffectNamed(e.name).Switches(p) && std::isfinite(p.null_value)) add(0.5);
  }
  return out;
}

/// A loop that the resonance brings near its limit answers out of all proportion to the size, and
/// at another frequency than the resonance's own: each start moves to the neighbour that explains
/// most until none explains more; one that loses the rotor shrinks until it holds it.
void Climb(const CaseModel& model, const FitResult& now, double effective_sample_size,
           SimulatedStart& start) {
  constexpr int kSteps = 8;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<SimulatedStart> next;
    if (std::isfinite(start.score))
      next = Neighbours(start.effect);
    else
      next = {{ScaledInstance(start.effect, 1.0 / 6)}};
    Simulate(model, now, effective_sample_size, next);
    const auto best = std::min_element(
        next.begin(), next.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    if (std::isfinite(start.score) && best->score >= start.score) return;
    start = *best;
  }
}

/// The starts of a resonance that explain most when they are simulated: the linear step knows sizes
/// and neighbouring frequencies badly where the loop answers strongly.
std::vector<EffectInstance> BestOf(const CaseModel& model, const FitResult& now,
                                   const std::vector<EffectInstance>& starts,
                                   double effective_sample_size) {
  constexpr std::size_t kClimbed = 5;
  constexpr double kWorthFitting = 4;  // of the score
  std::vector<SimulatedStart> order, climbed;
  for (const EffectInstance& e : starts) order.push_back({e});
  const auto sort = [](std::vector<SimulatedStart>& list) {
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.score < b.score; });
  };
  try {
    Simulate(model, now, effective_sample_size, order);
    sort(order);
    for (const SimulatedStart& s : order)
      if (climbed.size() < kClimbed &&
          std::none_of(climbed.begin(), climbed.end(),
                       [&](const auto& o) { return SameValley(o.effect, s.effect); }))
        climbed.push_back(s);
    for (SimulatedStart& start : climbed) Climb(model, now, effective_sample_size, start);
    sort(climbed);
  } catch (const InputError&) {
    return starts;  // refused: no start of it is any good
  }
  std::vector<EffectInstance> out;
  // a resonance of which no start explains anything is not there
  const double here = Score(model, now.ratio_fit, now.ratio_validate, effective_sample_size, 0, 0);
  const auto take = [&](const std::vector<SimulatedStart>& from) {
    for (const SimulatedStart& s : from) {
      if (s.score > here - kWorthFitting) return;
      if (std::any_of(out.begin(), out.end(),
                      [&](const EffectInstance& o) { return SameValley(o, s.effect); }))
        continue;
      out.push_back(s.effect);
      return;
    }
  };
  take(order);  // the best as it stands: where it is near, a fit finds its way
  take(climbed);
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

FitResult FitScreened(const CaseModel& model, const FitResult& base, const ScreenOptions& what) {
  constexpr std::size_t kTried = 3;
  SignatureBank bank;
  const std::vector<Candidate> candidates =
      Screen(model, base, FindPeaks(model, base.residual), what, bank);
  FitResult best;
  best.ratio_fit = kInfinity;
  for (std::size_t k = 0; k < std::min(candidates.size(), kTried); ++k) {
    FitResult fit = FitBriefly(model, base, candidates[k], what.effective_sample_size);
    if (fit.converged && fit.ratio_fit < best.ratio_fit) best = std::move(fit);
  }
  return best;
}

}  // namespace ambrig
