// What is believed: the rig's toleranced parameters and the effects' as free numbers.
#include "discovery/model/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ambrig {

Hypothesis Hypothesis::Base(const RigParameters& rig) {
  Hypothesis h;
  h.rig = rig;
  for (const Tolerance& t : rig.tolerances) {
    FreeParameter p;
    p.path = t.path;
    const double* at = ParameterAt(h.rig, t.path);
    if (!at || t.sd <= 0) continue;
    // the prior's mean; a calibration found earlier is where the fit starts
    p.value = p.start = *at;
    p.sd = p.step = t.sd;
    std::string unit;
    ParameterRange(rig, t.path, &p.lo, &p.hi, &unit);
    p.lo = std::max(p.lo, p.value - 8 * t.sd);
    p.hi = std::min(p.hi, p.value + 8 * t.sd);
    h.free.push_back(p);
    if (!std::isnan(t.true_value)) h.Set(h.free.size() - 1, t.true_value);
  }
  for (Tolerance& t : h.rig.tolerances) t.true_value = kRequired;  // now in the values
  // A formula that the user wrote is there to be fitted, and so is what an adoption found: { value,
  // sd }.
  const std::vector<EffectInstance> own = std::move(h.rig.effects);
  h.rig.effects.clear();
  for (const EffectInstance& e : own) {
    const std::size_t before = h.free.size();
    h.AddEffect(e);
    if (e.IsFormula()) continue;
    for (std::size_t k = h.free.size(); k-- > before;)
      if (e.sd[h.free[k].row] <= 0) h.free.erase(h.free.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return h;
}

void Hypothesis::AddEffect(const EffectInstance& effect) {
  const int index = static_cast<int>(rig.effects.size());
  rig.effects.push_back(effect);
  // where several sizes stand beside each other, one may be nothing
  const bool several = std::count_if(effect.table.begin(), effect.table.end(), [](const auto& e) {
                         return e.has_null && std::isfinite(e.null_value);
                       }) > 1;
  for (std::size_t row = 0; row < effect.table.size(); ++row) {
    const EffectParameter& e = effect.table[row];
    FreeParameter p;
    p.path = fmt::format("{}@{}.{}", effect.name, effect.target, e.name);
    p.effect = index;
    p.row = row;
    p.value = p.start = effect.values[row];
    p.lo = e.lo;
    p.hi = e.hi;
    if (!std::isfinite(p.value)) continue;  // at a null of infinity: not moved
    const double typical = std::max(std::abs(e.typical_hi), std::abs(e.typical_lo));
    p.step = 0.3 * typical;
    if (p.step == 0) p.step = std::isfinite(e.hi) && std::isfinite(e.lo) ? 0.05 * (e.hi - e.lo) : 1;
    // Sizes over decades move in ratios; signed ones and distances from a null (a gain of 1) in
    // steps.
    const bool distance =
        std::isfinite(e.null_value) && std::abs(e.typical_hi) <= 0.5 * std::abs(e.null_value);
    p.logarithmic = !distance && !(e.null_value == 0 && several) && e.typical_lo > 0 &&
                    e.typical_hi / e.typical_lo > 2.5 && e.lo >= 0 && p.value > 0;
    // as good as nothing; a ratio never gets there
    if (p.logarithmic) p.lo = std::max(e.lo, 1e-3 * e.typical_lo);
    free.push_back(p);
  }
}

bool Hypothesis::Holds(const EffectInstance& effect) const {
  return std::ranges::any_of(rig.effects,
                             [&](const EffectInstance& e) { return IsSameName(e, effect); });
}

void Hypothesis::Set(std::size_t parameter, double value) {
  FreeParameter& p = free[parameter];
  p.value = std::clamp(value, p.lo, p.hi);
  if (p.effect >= 0) {
    rig.effects[static_cast<std::size_t>(p.effect)].values[p.row] = p.value;
  } else {
    SetParameter(rig, p.path, p.value);
  }
}

double Hypothesis::Coordinate(std::size_t parameter) const {
  return CoordinateOf(parameter, free[parameter].value);
}

double Hypothesis::CoordinateOf(std::size_t parameter, double value) const {
  const FreeParameter& p = free[parameter];
  return p.logarithmic ? std::log(value / p.start) / 0.3 : (value - p.start) / p.step;
}

double Hypothesis::ValueAt(std::size_t parameter, double coordinate) const {
  const FreeParameter& p = free[parameter];
  const double v =
      p.logarithmic ? p.start * std::exp(0.3 * coordinate) : p.start + p.step * coordinate;
  return std::clamp(v, p.lo, p.hi);
}

}  // namespace ambrig
