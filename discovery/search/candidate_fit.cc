#include "discovery/search/candidate_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "discovery/search/likelihood.h"
#include "discovery/search/probes.h"
#include "discovery/search/start_search.h"

namespace ambrig {

namespace {

constexpr double kLongSteps = 1e4, kShortSteps = 10;  // trust regions

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

/// The trust region of a fit of `h`: that of long steps where the sizes of all effects that were
/// found act nearly in proportion. One that vanishes at infinity (a knee, a cutoff) does not, nor
/// does one whose shape may take both signs.
double TrustRegion(const CaseModel& model, const Hypothesis& h) {
  const auto in_proportion = [](const EffectInstance& e) {
    if (e.IsFormula()) return false;
    const EffectDescription& d = EffectNamed(e.name);
    return !IsResonance(d) && !d.needs.contact &&
           std::ranges::none_of(d.parameters, [&](const EffectParameter& p) {
             return d.Switches(p) ? !std::isfinite(p.null_value) : ShapesFurther(p);
           });
  };
  const std::vector<EffectInstance>& effects = h.rig.effects;
  const auto found = static_cast<std::ptrdiff_t>(model.data().rig.effects.size());
  return std::all_of(effects.begin() + found, effects.end(), in_proportion) ? kLongSteps
                                                                            : kShortSteps;
}

FitOptions Brief(const FitResult& now, double effective_sample_size) {
  FitOptions brief;
  brief.effective_sample_size = effective_sample_size;
  brief.base_jacobian = &now.jacobian;
  brief.reached = now.ratio_fit;
  brief.iterations = 4;
  brief.passes = 1;
  brief.tolerance = 1e-4;
  brief.least_share = 0.01;
  brief.sensitivities = false;
  return brief;
}

/// A fit; where it leaves far more than the signature promises also one with short steps, and the
/// better of the two: long ones may end in another valley.
FitResult FitAsPromised(const CaseModel& model, const Hypothesis& start, const Candidate& candidate,
                        const FitOptions& options) {
  constexpr double kFar = 2, kNear = 0.05;  // of the squared ratio above the noise
  const auto left = [](double ratio) { return std::max(0.0, ratio * ratio - 1); };
  FitResult fit = TryFit(model, start, options);
  const bool as_promised =
      fit.converged && left(fit.ratio_fit) < kFar * left(candidate.ratio_fit) + kNear;
  if (as_promised || options.trust_region == kShortSteps) return fit;
  FitOptions shorter = options;
  shorter.trust_region = kShortSteps;
  FitResult other = TryFit(model, start, shorter);
  const bool better = other.converged && (!fit.converged || other.ratio_fit < fit.ratio_fit);
  return better ? other : fit;
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

/// `start` without the optional shapes of its last effect: those whose null lies below their usual
/// range are put there and held. Nothing where it has none. A fit of such a shape has no slope near
/// its null, and may end far from there.
std::optional<Hypothesis> WithoutOptionalShapes(const Hypothesis& start) {
  if (start.rig.effects.empty()) return {};
  Hypothesis h = start;
  const int last = static_cast<int>(h.rig.effects.size()) - 1;
  const EffectInstance& e = start.rig.effects.back();
  if (e.IsFormula()) return {};
  const EffectDescription& d = EffectNamed(e.name);
  bool any = false;
  for (std::size_t row = 0; row < e.table.size(); ++row) {
    const EffectParameter& p = e.table[row];
    if (d.Switches(p) || !IsOptionalShape(p) || e.values[row] == p.null_value) continue;
    const auto removed = std::erase_if(
        h.free, [&](const FreeParameter& f) { return f.effect == last && f.row == row; });
    if (removed == 0) continue;
    h.rig.effects.back().values[row] = p.null_value;
    any = true;
  }
  return any ? std::optional(h) : std::nullopt;
}

/// From how many starts a climb is worth its simulations: the more the best explains as it stands,
/// the less likely another valley holds more. Few beside effects that were adopted.
std::size_t StartsToClimb(const SimulatedStart& best, bool beside_adopted) {
  if (beside_adopted || best.share > 0.8) return 2;
  return best.share > 0.4 ? 3 : 5;
}

/// The same start with a shorter and a longer shaft that bends: the shape of a mode between the
/// planes has valleys of its own.
std::vector<EffectInstance> OtherLengths(const EffectInstance& e) {
  std::vector<EffectInstance> out;
  for (std::size_t row = 0; row < e.table.size(); ++row) {
    if (e.table[row].name != "length") continue;
    for (const double factor : {0.6, 1.6}) {
      out.push_back(e);
      out.back().values[row] = std::clamp(e.values[row] * factor, e.table[row].lo, e.table[row].hi);
    }
  }
  return out;
}

/// The starts that explain most when they are simulated: the best as it stands, and the best that
/// is reached from it or another.
std::vector<EffectInstance> BestOf(const CaseModel& model, const FitResult& now,
                                   const std::vector<EffectInstance>& starts,
                                   double effective_sample_size) {
  std::vector<SimulatedStart> order, climbed;
  for (const EffectInstance& e : starts) {
    order.push_back({e});
    for (const EffectInstance& other : OtherLengths(e)) order.push_back({other});
  }
  const auto sort = [](std::vector<SimulatedStart>& list) {
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.score < b.score; });
  };
  try {
    const StartSearch search(model, now, effective_sample_size);
    search.Simulate(order);
    sort(order);
    const std::size_t most = StartsToClimb(order[0], search.beside_others());
    for (const SimulatedStart& s : order)
      if (climbed.size() < most && std::none_of(climbed.begin(), climbed.end(), [&](const auto& o) {
            return SameValley(o.effect, s.effect);
          }))
        climbed.push_back(s);
    search.Climb(climbed);
    std::vector<EffectInstance> out;
    // what explains nothing wherever it starts is not there
    const auto explains = [&](const SimulatedStart& s) { return search.Explains(s); };
    // where the best is near as it stands, a fit finds its way
    if (explains(order[0]) && !SameValley(order[0].effect, climbed[0].effect))
      out.push_back(order[0].effect);
    if (explains(climbed[0])) out.push_back(climbed[0].effect);
    return out;
  } catch (const InputError&) {
    return starts;  // refused: no start of it is any good
  }
}

}  // namespace

FitResult FitShortly(const CaseModel& model, const FitResult& now, const Hypothesis& start,
                     double effective_sample_size) {
  FitOptions brief = Brief(now, effective_sample_size);
  brief.trust_region = TrustRegion(model, start);
  return TryFit(model, start, brief);
}

FitResult FitBriefly(const CaseModel& model, const FitResult& now, const Candidate& candidate,
                     double effective_sample_size) {
  FitOptions brief = Brief(now, effective_sample_size);
  brief.lent = static_cast<std::size_t>(now.jacobian.cols());
  // weighed by what it promises: by the weight of an error that it takes away, the prior would hold
  // the rig parameters where they stood in for it
  if (candidate.ratio_fit > 0) brief.reached = std::min(brief.reached, candidate.ratio_fit);
  if (candidate.narrow) brief.iterations = 12;
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
    brief.trust_region = TrustRegion(model, h);
    FitResult fit = candidate.narrow ? FitResonance(model, h, brief)
                                     : FitAsPromised(model, h, candidate, brief);
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
  full.trust_region = TrustRegion(model, start);
  full.tolerance = 1e-4;
  FitResult fit = TryFit(model, start, full);
  const std::optional<Hypothesis> simpler = WithoutOptionalShapes(start);
  if (!simpler) return fit;
  FitResult without = TryFit(model, *simpler, full);
  const bool better =
      without.converged && (!fit.converged || Score(model, without, effective_sample_size) <
                                                  Score(model, fit, effective_sample_size));
  return better ? without : fit;
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
