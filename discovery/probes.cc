#include "discovery/probes.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

double Middle(const EffectParameter& p) {
  if (p.typical_lo > 0 && p.typical_hi > 0) return std::sqrt(p.typical_lo * p.typical_hi);
  return 0.5 * (p.typical_lo + p.typical_hi);
}

/// Size of a probe of a parameter whose null is finite: its usual magnitude, from the null.
double SizeFromNull(const EffectParameter& p) {
  if (p.null_value == 0) {
    const double most = std::max(std::abs(p.typical_hi), std::abs(p.typical_lo));
    const double least = std::min(std::abs(p.typical_hi), std::abs(p.typical_lo));
    return least > 0 ? std::sqrt(most * least) : 0.3 * most;
  }
  const double a = p.typical_hi - p.null_value, b = p.typical_lo - p.null_value;
  return 0.5 * (std::abs(a) > std::abs(b) ? a : b);
}

std::vector<double> LogGrid(double lo, double hi, int n) {
  std::vector<double> out;
  for (int k = 0; k < n; ++k) out.push_back(lo * std::pow(hi / lo, n == 1 ? 0.5 : static_cast<double>(k) / (n - 1)));
  return out;
}

void AppendApart(std::vector<double>& list, const std::vector<double>& more, double ratio) {
  for (double f : more)
    if (std::none_of(list.begin(), list.end(), [&](double g) { return std::abs(std::log(f / g)) < ratio; }))
      list.push_back(f);
}

/// Values at which the shape parameters (frequency, width, ...) are tried together with the switches.
std::vector<double> FrequencySeeds(const EffectDescription& d, const std::string& target, const EffectParameter& p,
                                   const CaseModel& model, const std::vector<double>& residual) {
  std::vector<double> seeds;
  const bool tone = d.id == "sensor-hum" || d.id == "base-vibration";
  if (tone) {
    seeds = CoherentPeaks(model, residual, target, 2);
    AppendApart(seeds, {50, 60}, 0.01);
  } else {
    seeds = SpectrumPeaks(model, residual, 3);
    AppendApart(seeds, LogGrid(p.typical_lo, p.typical_hi, 7), 0.08);
  }
  std::erase_if(seeds, [&](double f) { return f < p.lo || f > p.hi; });
  return seeds;
}

/// Effects whose signature is quadratic in two gains: try sign patterns of a middle size.
ProbeGroup Pattern(EffectInstance e, const std::string& a, double va, const std::string& b, double vb) {
  e.Set(a, va);
  e.Set(b, vb);
  ProbeGroup g;
  g.linear = false;
  g.probes.push_back(std::move(e));
  return g;
}

}  // namespace

std::vector<ProbeGroup> ProbesOf(const EffectDescription& d, const std::string& target, const CaseModel& model,
                                 const std::vector<double>& residual) {
  EffectInstance null = MakeInstance(d, target);
  std::vector<std::size_t> finite, infinite, shape;
  std::size_t frequency = d.parameters.size();
  for (std::size_t k = 0; k < d.parameters.size(); ++k) {
    const EffectParameter& p = d.parameters[k];
    const bool is_switch = d.off_when_null.empty() ||
                           std::find(d.off_when_null.begin(), d.off_when_null.end(), p.name) != d.off_when_null.end();
    if (is_switch) {
      (std::isfinite(p.null_value) ? finite : infinite).push_back(k);
    } else {
      // A shape parameter whose null is inside its usual range (an optional extra) stays at its null.
      if (p.name == "frequency") frequency = k;
      else if (p.typical_lo > 0 || p.typical_hi < 0) null.values[k] = Middle(p);
      shape.push_back(k);
    }
  }
  std::vector<double> frequencies = {0};
  if (frequency < d.parameters.size())
    frequencies = FrequencySeeds(d, target, d.parameters[frequency], model, residual);
  std::vector<ProbeGroup> groups;
  for (double f : frequencies) {
    EffectInstance at = null;
    if (frequency < d.parameters.size()) at.values[frequency] = f;
    if (d.id == "bending-mode") {
      const double size = Middle(d.parameters[finite[0]]) > 0 ? Middle(d.parameters[finite[0]]) : SizeFromNull(d.parameters[finite[0]]);
      groups.push_back(Pattern(at, "gain_a", size, "gain_b", size));
      groups.push_back(Pattern(at, "gain_a", size, "gain_b", -size));
      continue;
    }
    if (d.id == "loop-delay") {  // acts in whole switching periods
      const double T = 1 / model.data().rig.amplifier.switching_frequency;
      for (int k = 1; k <= 6; ++k) {
        ProbeGroup g;
        g.linear = false;
        EffectInstance e = at;
        e.Set("time", (k - 0.25) * T);
        g.probes.push_back(e);
        groups.push_back(g);
      }
      continue;
    }
    for (std::size_t k : infinite) {
      const EffectParameter& p = d.parameters[k];
      for (double value : LogGrid(p.typical_lo, p.typical_hi, frequency < d.parameters.size() ? 2 : 4)) {
        ProbeGroup g;
        g.linear = false;
        EffectInstance e = at;
        e.values[k] = value;
        g.probes.push_back(e);
        groups.push_back(g);
      }
    }
    if (finite.empty()) continue;
    ProbeGroup g;
    for (std::size_t k : finite) {
      EffectInstance e = at;
      e.values[k] = d.parameters[k].null_value + SizeFromNull(d.parameters[k]);
      g.probes.push_back(e);
      g.rows.push_back(k);
    }
    groups.push_back(g);
  }
  return groups;
}

}  // namespace ambrig
