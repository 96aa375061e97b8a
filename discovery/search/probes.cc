#include "discovery/search/probes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ambrig {

bool IsResonance(const EffectDescription& d) {
  const auto has = [&](const char* name) {
    return std::any_of(d.parameters.begin(), d.parameters.end(),
                       [&](const EffectParameter& p) { return p.name == name; });
  };
  return has("frequency") && has("damping");
}

bool IsOptionalShape(const EffectParameter& p) {
  return std::isfinite(p.null_value) && p.lo <= p.null_value && p.null_value < p.typical_lo;
}

bool ShapesFurther(const EffectParameter& p) {
  return p.typical_lo < p.null_value && p.null_value < p.typical_hi;
}

namespace {

double Middle(const EffectParameter& p) {
  if (p.typical_lo > 0 && p.typical_hi > 0) return std::sqrt(p.typical_lo * p.typical_hi);
  return 0.5 * (p.typical_lo + p.typical_hi);
}

/// Size of a probe of a parameter whose null is finite: its usual distance from there.
double SizeFromNull(const EffectParameter& p) {
  const double most = std::max(std::abs(p.typical_hi), std::abs(p.typical_lo));
  const double least = std::min(std::abs(p.typical_hi), std::abs(p.typical_lo));
  return least > 0 ? std::sqrt(most * least) : 0.3 * most;
}

std::vector<double> LogGrid(double lo, double hi, int n) {
  std::vector<double> out;
  for (int k = 0; k < n; ++k)
    out.push_back(lo * std::pow(hi / lo, n == 1 ? 0.5 : static_cast<double>(k) / (n - 1)));
  return out;
}

/// A resonance is sought with more damping than it has: it is felt from further off, and a fit from
/// there finds its way down to the true one.
constexpr double kSoughtDamping = 0.05;
constexpr double kSoughtSpacing = 1.1;  // of neighbouring frequencies, about its width
// of its usual top: large gains shift the loop's resonance, a small probe misses that
constexpr double kSoughtGain = 0.4;
// amounts for which the signature of a resonance is believed, and of the weakest probe of what
// vanishes at infinity
constexpr double kLeastAmount = 0.01, kMostOfResonance = 30;

/// It answers to its gains squared: both signs of their ratio, the size to be found.
std::vector<ProbeGroup> GainPatterns(const EffectInstance& at, std::size_t a, std::size_t b,
                                     double size) {
  std::vector<ProbeGroup> groups;
  for (const double sign : {1.0, -1.0}) {
    ProbeGroup g;
    g.linear = false;
    g.scaling = {{a, 0.5}, {b, 0.5}};
    g.least = kLeastAmount;
    g.most = kMostOfResonance;
    g.probes.push_back(at);
    g.probes[0].values[a] = size;
    g.probes[0].values[b] = sign * size;
    groups.push_back(g);
  }
  return groups;
}

/// Values at which the shape parameters (frequency, width, ...) are tried together with the
/// switches.
std::vector<double> FrequencySeeds(const EffectDescription& d, const std::string& target,
                                   const EffectParameter& p, const ResidualPeaks& peaks) {
  std::vector<double> seeds;
  if (d.tone) {
    const auto strongest = peaks.coherent.find(target), tones = peaks.tones.find(target);
    if (tones != peaks.tones.end() && !tones->second.empty())
      seeds = tones->second;
    else
      seeds = WithMains(strongest == peaks.coherent.end() ? seeds : strongest->second);
  } else {
    seeds = peaks.spectrum;
    const int n = IsResonance(d)
                      ? static_cast<int>(std::ceil(std::log(p.typical_hi / p.typical_lo) /
                                                   std::log(kSoughtSpacing)))
                      : 7;
    AppendApart(seeds, LogGrid(p.typical_lo, p.typical_hi, n), 0.06);
  }
  std::erase_if(seeds, [&](double f) { return f < p.lo || f > p.hi; });
  return seeds;
}

/// What shapes a law over decades is tried at the ends of its usual range too: laminations thin and
/// thick, a capacitance that smooths and one that does not. A shape that may be left out is tried
/// without: iron so thick that its thickness does not show, fringing flux that does not pull. A fit
/// of it has no slope there, and with it the signature may look like a rig parameter's (fringing
/// that pulls: a larger pole area).
std::vector<EffectInstance> FormsOf(const EffectDescription& d, const EffectInstance& middle,
                                    const std::vector<std::size_t>& shape, bool both_ends) {
  std::vector<EffectInstance> forms = {middle};
  for (std::size_t s : shape) {
    const EffectParameter& p = d.parameters[s];
    if (p.name == "frequency" || IsResonance(d) || p.typical_lo <= 0) continue;
    if (IsOptionalShape(p)) {
      forms.push_back(middle);
      forms.back().values[s] = p.null_value;
    }
    if (p.typical_hi < 4 * p.typical_lo) continue;
    forms.push_back(middle);
    forms.back().values[s] = p.typical_hi;
    if (!both_ends) continue;
    forms.push_back(middle);
    forms.back().values[s] = p.typical_lo;
  }
  return forms;
}

/// The rows of an effect by what a probe does with them, and the effect at its null with its shape
/// at the middle of the usual range.
struct ProbePlan {
  EffectInstance null;
  std::vector<std::size_t> finite, infinite, shape;  // switches by their null; what shapes the law
  std::optional<std::size_t> frequency;
};

ProbePlan PlanOf(const EffectDescription& d, const std::string& target) {
  ProbePlan plan{MakeInstance(d, target), {}, {}, {}, {}};
  for (std::size_t k = 0; k < d.parameters.size(); ++k) {
    const EffectParameter& p = d.parameters[k];
    if (d.Switches(p)) {
      (std::isfinite(p.null_value) ? plan.finite : plan.infinite).push_back(k);
      continue;
    }
    // A shape parameter whose null is inside its usual range (an optional extra) stays at its null.
    if (p.name == "frequency")
      plan.frequency = k;
    else if (p.name == "damping" && IsResonance(d))
      plan.null.values[k] = kSoughtDamping;
    else if (p.typical_lo > 0 || p.typical_hi < 0)
      plan.null.values[k] = Middle(p);
    plan.shape.push_back(k);
  }
  return plan;
}

/// An effect that acts in whole switching periods T [s]: the first six, by the middle of what acts
/// as this one.
std::vector<ProbeGroup> WholePeriods(const EffectDescription& d, const EffectInstance& at,
                                     double T) {
  std::vector<ProbeGroup> groups;
  for (int k = 1; k <= 6; ++k) {
    ProbeGroup g;
    g.linear = false;
    g.probes.push_back(at);
    g.probes[0].Set(d.whole_periods, (k - 0.5) * T);
    groups.push_back(g);
  }
  return groups;
}

/// A switch whose null is infinite: one probe each of several finite sizes.
std::vector<ProbeGroup> FromInfinity(const EffectDescription& d, const ProbePlan& plan,
                                     const EffectInstance& at, std::size_t k) {
  std::vector<ProbeGroup> groups;
  const EffectParameter& p = d.parameters[k];
  for (const EffectInstance& form : FormsOf(d, at, plan.shape, false))
    for (double value : LogGrid(p.typical_lo, p.typical_hi, IsResonance(d) ? 1 : 4)) {
      ProbeGroup g;
      g.linear = false;
      if (IsResonance(d)) {
        g.scaling = {{k, -1.0}};  // a mass
        g.least = kLeastAmount;
        g.most = kMostOfResonance;
      } else if (value > 0.99 * p.typical_hi) {  // the effect may be as weak as it likes
        g.scaling = {{k, -1 / d.vanishing_order}};
        g.least = kLeastAmount;
      }
      g.probes.push_back(form);
      g.probes[0].values[k] = value;
      groups.push_back(g);
    }
  return groups;
}

/// Switches whose null is finite: linear, one probe of each.
std::vector<ProbeGroup> FromNull(const EffectDescription& d, const ProbePlan& plan,
                                 const EffectInstance& at) {
  std::vector<ProbeGroup> groups;
  if (plan.finite.empty()) return groups;
  for (const EffectInstance& form : FormsOf(d, at, plan.shape, true)) {
    ProbeGroup g;
    for (std::size_t k : plan.finite) {
      g.probes.push_back(form);
      g.probes.back().values[k] = d.parameters[k].null_value + SizeFromNull(d.parameters[k]);
      g.rows.push_back(k);
    }
    groups.push_back(g);
  }
  return groups;
}

}  // namespace

std::vector<ProbeGroup> ProbesOf(const EffectDescription& d, const std::string& target,
                                 const CaseModel& model, const ResidualPeaks& peaks) {
  const ProbePlan plan = PlanOf(d, target);
  std::vector<double> frequencies = {0};
  if (plan.frequency) frequencies = FrequencySeeds(d, target, d.parameters[*plan.frequency], peaks);
  std::vector<ProbeGroup> groups;
  const auto add = [&](const std::vector<ProbeGroup>& more) {
    groups.insert(groups.end(), more.begin(), more.end());
  };
  for (const double f : frequencies) {
    EffectInstance at = plan.null;
    if (plan.frequency) at.values[*plan.frequency] = f;
    if (d.switches_pair) {
      const std::size_t a = plan.finite[0];
      add(GainPatterns(at, a, plan.finite[1], kSoughtGain * d.parameters[a].typical_hi));
    } else if (!d.whole_periods.empty()) {
      add(WholePeriods(d, at, 1 / model.data().rig.amplifier.switching_frequency));
    } else {
      for (const std::size_t k : plan.infinite) add(FromInfinity(d, plan, at, k));
      add(FromNull(d, plan, at));
    }
  }
  // Impacts answer to their law as resonances do to theirs: only a simulation tells.
  for (ProbeGroup& g : groups) g.narrow = IsResonance(d) || d.needs.contact;
  return groups;
}

}  // namespace ambrig
