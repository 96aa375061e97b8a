#include "analysis/shaft/shaft_scatter.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "analysis/shaft/shaft_campbell.h"
#include "core/math/constants.h"
#include "core/math/noise.h"

namespace ambrig {

namespace {

/// Frequency and log decrement of every mode of one rotor.
struct ScatterSample {
  std::vector<double> frequency, decrement;
};

double Drawn(const ShaftParameter& p, double sd, std::uint64_t seed, std::size_t parameter,
             std::size_t rotor) {
  constexpr std::uint64_t kTries = 1000;
  const auto stream = static_cast<std::uint32_t>(parameter);
  for (std::uint64_t t = 0; t < kTries; ++t) {
    const double value = p.value + sd * Normal(seed, stream, rotor * kTries + t);
    if (value >= p.lo && value <= p.hi) return value;
  }
  return p.value;
}

ScatterSample Sampled(const BeamFile& file, double speed, std::vector<WhirlMode> modes) {
  const BeamRotor beam = BuildBeam(file.definition);
  const LinearRotor rotor = Assemble(beam, speed);
  if (!ContinueModes(rotor, speed, modes)) {
    // Far from the nominal rotor: all its modes, paired by the nearest pole.
    const int count = static_cast<int>(modes.size());
    const auto all =
        FindWhirlModes(rotor, ShapesOfBeam(beam, speed, count), speed, 2 * count).oscillatory;
    for (WhirlMode& m : modes) {
      const auto nearest = std::min_element(
          all.begin(), all.end(),
          [&](const auto& a, const auto& b) { return std::abs(a.s - m.s) < std::abs(b.s - m.s); });
      if (nearest != all.end()) m = *nearest;
    }
  }
  ScatterSample out;
  for (const WhirlMode& m : modes) {
    out.frequency.push_back(m.omega_d / (2 * kPi));
    out.decrement.push_back(m.log_decrement);
  }
  return out;
}

/// Between order statistics, as (k - 1/2)/n.
double Quantile(std::vector<double>& v, double p) {
  std::sort(v.begin(), v.end());
  const double at =
      std::clamp(p * static_cast<double>(v.size()) - 0.5, 0.0, static_cast<double>(v.size() - 1));
  const auto k = static_cast<std::size_t>(at);
  return k + 1 < v.size() ? std::lerp(v[k], v[k + 1], at - static_cast<double>(k)) : v[k];
}

ScatterBand BandOf(std::vector<double> v) {
  return {Quantile(v, 0.05), Quantile(v, 0.5), Quantile(v, 0.95)};
}

}  // namespace

ShaftScatter ScatterShaft(const BeamFile& file, const std::vector<Tolerance>& tolerances,
                          double speed, int modes, int rotors, std::uint64_t seed,
                          const std::function<bool(double)>& go_on) {
  if (tolerances.empty())
    throw InputError(
        "--scatter: no number of the shaft has an sd, allowed: numbers written { value = ..., sd = "
        "... }");
  ShaftScatter out;
  out.rotors = rotors;
  out.speed = speed;
  for (const Tolerance& t : tolerances) out.parameters.push_back(t.path);
  const BeamRotor nominal = BuildBeam(file.definition);
  const std::vector<WhirlMode> start =
      FindWhirlModes(Assemble(nominal, speed), ShapesOfBeam(nominal, speed, modes), speed, modes)
          .oscillatory;
  std::vector<ScatterSample> samples(static_cast<std::size_t>(rotors));
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stopped{false};
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t k) {
    if (stopped) return;
    BeamFile drawn = file;
    for (std::size_t p = 0; p < file.parameters.size(); ++p)
      for (const auto& set : file.parameters[p].set)
        set(drawn, Drawn(file.parameters[p], tolerances[p].sd, seed, p, k));
    samples[k] = Sampled(drawn, speed, start);
    const double part = static_cast<double>(++done) / static_cast<double>(samples.size());
    if (go_on && !go_on(part)) stopped = true;
  });
  if (stopped) return out;
  for (std::size_t m = 0; m < start.size(); ++m) {
    std::vector<double> f, d;
    for (const ScatterSample& s : samples) {
      f.push_back(s.frequency[m]);
      d.push_back(s.decrement[m]);
    }
    out.modes.push_back(
        {start[m].omega_d / (2 * kPi), start[m].log_decrement, BandOf(f), BandOf(d)});
  }
  return out;
}

}  // namespace ambrig
