#include "discovery/search/probes.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

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

void AppendApart(std::vector<double>& list, const std::vector<double>& more, double ratio) {
  for (double f : more)  // neighbours of what stands there already are left out
    if (std::none_of(list.begin(), list.end(),
                     [&](double g) { return std::abs(std::log(f / g)) < ratio; }))
      list.push_back(f);
}

/// A resonance is sought with more damping than it has: it is felt from further off, and a fit from
/// there finds its way down to the true one.
constexpr double kSoughtDamping = 0.05;
constexpr double kSoughtSpacing = 1.1;  // of neighbouring frequencies, about its width
// of its usual top: large gains shift the loop's resonance, a small probe misses that
constexpr double kSoughtGain = 0.4;

bool IsResonance(const EffectDescription& d) {
  const auto has = [&](const char* name) {
    return std::any_of(d.parameters.begin(), d.parameters.end(),
                       [&](const EffectParameter& p) { return p.name == name; });
  };
  return has("frequency") && has("damping");
}

/// It answers to its gains squared: both signs of their ratio, the size to be found.
std::vector<ProbeGroup> GainPatterns(const EffectInstance& at, std::size_t a, std::size_t b,
                                     double size) {
  std::vector<ProbeGroup> groups;
  for (const double sign : {1.0, -1.0}) {
    ProbeGroup g;
    g.linear = false;
    g.scaling = {{a, 0.5}, {b, 0.5}};
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
    if (const auto it = peaks.coherent.find(target); it != peaks.coherent.end()) seeds = it->second;
    AppendApart(seeds, {50, 60}, 0.01);
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
/// thick, a capacitance that smooths and one that does not.
std::vector<EffectInstance> FormsOf(const EffectDescription& d, const EffectInstance& middle,
                                    const std::vector<std::size_t>& shape, bool both_ends) {
  std::vector<EffectInstance> forms = {middle};
  for (std::size_t s : shape) {
    const EffectParameter& p = d.parameters[s];
    if (p.name == "frequency" || IsResonance(d) || p.typical_lo <= 0 ||
        p.typical_hi < 4 * p.typical_lo)
      continue;
    forms.push_back(middle);
    forms.back().values[s] = p.typical_hi;
    if (!both_ends) continue;
    forms.push_back(middle);
    forms.back().values[s] = p.typical_lo;
  }
  return forms;
}

}  // namespace

std::vector<ProbeGroup> ProbesOf(const EffectDescription& d, const std::string& target,
                                 const CaseModel& model, const ResidualPeaks& peaks) {
  EffectInstance null = MakeInstance(d, target);
  std::vector<std::size_t> finite, infinite, shape;
  std::size_t frequency = d.parameters.size();
  for (std::size_t k = 0; k < d.parameters.size(); ++k) {
    const EffectParameter& p = d.parameters[k];
    if (d.Switches(p)) {
      (std::isfinite(p.null_value) ? finite : infinite).push_back(k);
    } else {
      // A shape parameter whose null is inside its usual range (an optional extra) stays at its
      // null.
      if (p.name == "frequency")
        frequency = k;
      else if (p.name == "damping" && IsResonance(d))
        null.values[k] = kSoughtDamping;
      else if (p.typical_lo > 0 || p.typical_hi < 0)
        null.values[k] = Middle(p);
      shape.push_back(k);
    }
  }
  std::vector<double> frequencies = {0};
  if (frequency < d.parameters.size())
    frequencies = FrequencySeeds(d, target, d.parameters[frequency], peaks);
  std::vector<ProbeGroup> groups;
  for (double f : frequencies) {
    EffectInstance at = null;
    if (frequency < d.parameters.size()) at.values[frequency] = f;
    if (d.switches_pair) {
      for (ProbeGroup& g :
           GainPatterns(at, finite[0], finite[1], kSoughtGain * d.parameters[finite[0]].typical_hi))
        groups.push_back(std::move(g));
      continue;
    }
    if (!d.whole_periods.empty()) {
      const double T = 1 / model.data().rig.amplifier.switching_frequency;
      for (int k = 1; k <= 6; ++k) {
        ProbeGroup g;
        g.linear = false;
        EffectInstance e = at;
        e.Set(d.whole_periods, k * T * (1 - 1e-6));
        g.probes.push_back(e);
        groups.push_back(g);
      }
      continue;
    }
    for (std::size_t k : infinite) {
      const EffectParameter& p = d.parameters[k];
      for (const EffectInstance& form : FormsOf(d, at, shape, false))
        for (double value : LogGrid(p.typical_lo, p.typical_hi, IsResonance(d) ? 1 : 4)) {
          ProbeGroup g;
          g.linear = false;
          if (IsResonance(d)) g.scaling = {{k, -1.0}};  // a mass
          EffectInstance e = form;
          e.values[k] = value;
          g.probes.push_back(e);
          groups.push_back(g);
        }
    }
    if (finite.empty()) continue;
    for (const EffectInstance& form : FormsOf(d, at, shape, true)) {
      ProbeGroup g;
      for (std::size_t k : finite) {
        EffectInstance e = form;
        e.values[k] = d.parameters[k].null_value + SizeFromNull(d.parameters[k]);
        g.probes.push_back(e);
        g.rows.push_back(k);
      }
      groups.push_back(g);
    }
  }
  for (ProbeGroup& g : groups) g.narrow = IsResonance(d);
  return groups;
}

}  // namespace ambrig
