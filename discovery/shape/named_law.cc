#include "discovery/shape/named_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/case/effect_target.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/screen.h"
#include "discovery/shape/shape_fit.h"
#include "effects/law_tables.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

/// Number of the effect in the rig file, or that of its effects when it is not there.
std::size_t Known(const Hypothesis& h, const std::string& effect, const std::string& target) {
  const std::vector<EffectInstance>& all = h.rig.effects;
  std::size_t k = 0;
  while (k < all.size() && !(all[k].name == effect && (target.empty() || all[k].target == target)))
    ++k;
  return k;
}

}  // namespace

NamedLaw FitNamedLaw(const CaseModel& model, const std::string& effect, const std::string& target,
                     double effective_sample_size,
                     const std::function<void(double, const std::string&)>& progress) {
  RequireTarget(EffectNamed(effect), model.data().rig, target,
                fmt::format("{}@{}: no such target, allowed:", effect, target));
  NamedLaw out;
  FitOptions options;
  options.effective_sample_size = effective_sample_size;
  Hypothesis nominal = Hypothesis::Base(model.data().rig);
  out.index = Known(nominal, effect, target);
  if (out.index < nominal.rig.effects.size()) {
    // as it stands in the rig file: all of its numbers are free again
    const EffectInstance known = nominal.rig.effects[out.index];
    nominal = WithoutEffect(nominal, out.index);
    out.index = nominal.rig.effects.size();
    out.base = Fit(model, nominal, options);
    Hypothesis with = out.base.hypothesis;
    with.AddEffect(known);
    out.fit = Fit(model, with, options);
  } else {
    out.base = Fit(model, nominal, options);
    progress(0.3, "the catalogue's law");
    ScreenOptions what;
    what.effective_sample_size = effective_sample_size;
    what.effect = effect;
    what.target = target;
    out.fit = FitScreened(model, out.base, what);
    if (out.fit.converged) out.fit = Fit(model, out.fit.hypothesis, options);
  }
  if (!out.fit.converged)
    throw InputError(fmt::format("{}: no fit of {} to these records holds the rotor",
                                 model.data().file, effect));
  return out;
}

namespace {

/// A kink of the magnetisation curve at B that shows when any record goes beyond it.
Hypothesis WithKink(const Hypothesis& h, const std::string& bearing, double B) {
  EffectInstance kink = MakeInstance(EffectNamed("bh-curve"), bearing);
  kink.Set("reach", B * (kBhNodes - 1) / (kBhNodes - 2));
  kink.Set(fmt::format("path{}", kBhNodes - 1), 1e-4);
  Hypothesis out = h;
  out.rig.effects.push_back(kink);
  return out;
}

}  // namespace

double LargestDensity(const CaseModel& model, const Hypothesis& h, const std::string& bearing) {
  constexpr double kLeast = 1e-4, kMost = 4, kSeen = 1e-3;  // [T], [T], rms over the floor
  constexpr int kPoints = 8;
  const auto base = model.Predict(h);
  if (!base) return 0;
  double lo = kLeast, hi = kMost;  // seen at lo, not at hi
  for (int round = 0; round < 3; ++round) {
    std::vector<double> at;
    std::vector<Hypothesis> all;
    for (int k = 0; k < kPoints; ++k) {
      at.push_back(lo * std::pow(hi / lo, (k + (round == 0 ? 0.0 : 1.0)) /
                                              (kPoints + (round == 0 ? -1.0 : 1.0))));
      all.push_back(WithKink(h, bearing, at.back()));
    }
    const auto runs = model.PredictAll(all);
    bool any = round > 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      double sum = 0, n = 1;
      if (runs[k])
        for (const Target& t : model.targets())
          for (std::size_t row = t.first; row < t.first + t.count; ++row) {
            if (!model.ok()[row]) continue;
            sum += std::pow(((*runs[k])[row] - (*base)[row]) / t.floor, 2);
            n += 1;
          }
      const bool seen = !runs[k] || std::sqrt(sum / n) > kSeen;
      any = any || seen;
      if (seen) lo = std::max(lo, at[k]);
    }
    if (!any) return 0;
    for (const double B : at)
      if (B > lo) {
        hi = B;
        break;
      }
  }
  return hi;
}

ShapeReach ReachOf(const CaseModel& model, const Hypothesis& h, const EffectInstance& named) {
  ShapeReach reach;
  if (DependsOnFlux(named.name)) reach.density = LargestDensity(model, h, named.target);
  for (const CaseRecord& r : model.data().records) {
    reach.speed = std::max(reach.speed, r.scenario.speed.LargestSpeed(r.scenario.duration));
    if (r.scenario.start == StartState::kClamped) continue;
    const Channel* axis = r.data.Find(named.target);  // nullptr: the target is a plane
    const Channel *x = axis ? axis : r.data.Find(named.target + ".x"),
                  *y = axis ? nullptr : r.data.Find(named.target + ".y");
    if (!axis && (!x || !y)) continue;
    for (std::size_t k = 0; k < x->samples.size(); ++k) {
      const double at = y ? std::hypot(x->samples[k], y->samples[k]) : std::abs(x->samples[k]);
      if (std::isfinite(at)) reach.radius = std::max(reach.radius, at);
    }
  }
  return reach;
}

}  // namespace ambrig
