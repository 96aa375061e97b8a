#include "discovery/practice/drawn_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "effects/catalogue.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

/// Streams of random numbers of one seed.
enum TruthStream : std::uint32_t { kParameters = 101, kTargets, kSizeStream };

constexpr std::uint64_t kUnitNumbers = 100000;

}  // namespace

RigParameters DrawRig(const RigParameters& rig, std::uint64_t seed) {
  RigParameters truth = rig;
  std::uint64_t k = 0;
  for (const Tolerance& t : rig.tolerances)
    if (const double* at = ParameterAt(rig, t.path))
      SetParameter(truth, t.path,
                   *at + t.sd * std::clamp(Normal(seed, kParameters, k++), -2.5, 2.5));
  truth.amplifier.unit += 1 + static_cast<double>(seed % kUnitNumbers);
  return truth;
}

EffectInstance DrawEffect(const EffectDescription& d, const std::string& target, std::uint64_t seed,
                          std::uint32_t slot) {
  EffectInstance e = MakeInstance(d, target);
  for (std::size_t k = 0; k < d.parameters.size(); ++k) {
    const EffectParameter& p = d.parameters[k];
    const auto index = slot * 64 + 2 * static_cast<std::uint32_t>(k);
    const double size = p.typical_lo > 0
                            ? p.typical_lo * std::pow(p.typical_hi / p.typical_lo,
                                                      Uniform(seed, kSizeStream, index))
                            : p.null_value;
    const double sign = Uniform(seed, kSizeStream, index + 1) < 0.5 ? -1 : 1;
    if (d.mains && p.name == "frequency") e.values[k] = sign > 0 ? 50 : 60;
    // an optional extra stays out
    else if (!d.Switches(p))
      e.values[k] = p.null_value == 0 ? 0 : size;
    else if (std::isinf(p.null_value))
      e.values[k] = size;
    else
      e.values[k] = std::clamp(p.null_value + (p.null_value + sign * size < p.lo ? 1 : sign) * size,
                               p.lo, p.hi);
  }
  return e;
}

EffectInstance ScaledEffect(const EffectDescription& d, const EffectInstance& e, double k) {
  EffectInstance out = e;
  for (std::size_t row = 0; row < d.parameters.size(); ++row) {
    const EffectParameter& p = d.parameters[row];
    if (!d.Switches(p)) continue;
    if (std::isinf(p.null_value)) {
      out.values[row] = std::clamp(std::max(e.values[row] / k, 0.5 * p.typical_lo), p.lo, p.hi);
      continue;
    }
    const double distance =
        std::clamp(k * (e.values[row] - p.null_value), -2 * p.typical_hi, 2 * p.typical_hi);
    out.values[row] = std::clamp(p.null_value + distance, p.lo, p.hi);
  }
  return out;
}

std::string DrawTarget(const EffectDescription& d, const RigParameters& rig,
                       const std::string& wanted, std::uint64_t seed, std::uint32_t slot) {
  const std::vector<std::string> possible = TargetsOf(d, TargetsOfEffects(rig));
  std::string names;
  for (const std::string& t : possible) {
    if (t == wanted) return t;
    names += (names.empty() ? "" : ", ") + t;
  }
  if (possible.empty())
    throw InputError(fmt::format("{}: this rig has no target for this effect", d.id));
  if (!wanted.empty())
    throw InputError(fmt::format("{}@{}: no such target, allowed: {}", d.id, wanted, names));
  return possible[static_cast<std::size_t>(Uniform(seed, kTargets, slot) *
                                           static_cast<double>(possible.size()))];
}

}  // namespace ambrig
