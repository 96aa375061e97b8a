#include "discovery/search/resonance_starts.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rotor/linear/linear_rotor.h"

namespace ambrig {

namespace {

constexpr int kDirections = 36;  // of two gains, over half a turn
constexpr int kForms = 25;       // of a shape parameter, over somewhat more than its usual range
constexpr double kWider = 1.4;
constexpr double kApartForms = 0.12;  // forms whose shapes differ by less are alike
constexpr std::size_t kForEach = 3;   // starts for each estimate
constexpr double kLeastSplit = 0.02,
                 kMostSplit = 0.7;  // of two frequencies (logarithm of their ratio)
constexpr double kResembles =
    0.5;  // least share of the estimate's gains (squares) that a start has

/// Answer of the first sensor axis to the first force axis, bearing by bearing, two bearings.
Eigen::Matrix2cd ShaftAt(const RigParameters& rig, double w) {
  const LinearRotor linear = LinearRotorOf(BuildPlant(TrueRig(rig)));
  const Eigen::MatrixXcd dynamic = -w * w * linear.M.cast<std::complex<double>>() +
                                   std::complex<double>(0, w) * linear.D + linear.K;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(dynamic);
  std::vector<const LinearPort*> ports;
  for (const BearingParameters& b : rig.bearings)
    for (const LinearPort& p : linear.ports)
      if (b.kind->eight_poles && p.name == b.name) ports.push_back(&p);
  Eigen::Matrix2cd out;
  for (Eigen::Index b = 0; b < 2; ++b) {
    const Eigen::VectorXcd q =
        lu.solve(ports[static_cast<std::size_t>(b)]->B.col(0).cast<std::complex<double>>());
    for (Eigen::Index s = 0; s < 2; ++s)
      out(s, b) = (ports[static_cast<std::size_t>(s)]->C.row(0) * q)(0);
  }
  return out;
}

void SetIfThere(EffectInstance& e, const std::string& name, double value) {
  for (std::size_t k = 0; k < e.table.size(); ++k)
    if (e.table[k].name == name) e.values[k] = std::clamp(value, e.table[k].lo, e.table[k].hi);
}

/// The forms at the estimate's frequency whose gains are tried: directions of two gains, values of
/// what shapes them.
std::vector<EffectInstance> FormsAt(const EffectInstance& null, const ResonanceEstimate& estimate) {
  const EffectDescription& d = EffectNamed(null.name);
  EffectInstance at = null;
  SetIfThere(at, "frequency", estimate.frequency);
  SetIfThere(at, "damping", estimate.damping);
  SetIfThere(at, "gyro", estimate.gyro);
  std::vector<EffectInstance> forms = {at};
  std::vector<std::size_t> gains;
  for (std::size_t k = 0; k < at.table.size(); ++k) {
    const EffectParameter& p = at.table[k];
    if (d.Switches(p)) {
      if (d.switches_pair)
        gains.push_back(k);
      else
        for (EffectInstance& e : forms) e.values[k] = p.typical_lo;
      continue;
    }
    if (p.name == "frequency" || p.name == "damping" || p.name == "gyro" || p.name == "ratio")
      continue;
    std::vector<EffectInstance> more;
    const double lo = p.typical_lo / kWider, hi = p.typical_hi * kWider;
    for (const EffectInstance& e : forms)
      for (int n = 0; n < kForms; ++n) {
        more.push_back(e);
        more.back().values[k] = std::clamp(lo * std::pow(hi / lo, n / (kForms - 1.0)), p.lo, p.hi);
      }
    forms = std::move(more);
  }
  if (gains.size() != 2) return forms;
  std::vector<EffectInstance> turned;
  for (const EffectInstance& e : forms)
    for (int n = 0; n < kDirections; ++n) {
      turned.push_back(e);
      for (const std::size_t k : {0u, 1u}) {
        const double angle = kPi * n / kDirections - (k == 1 ? kPi / 2 : 0);
        turned.back().values[gains[k]] = 0.1 * at.table[gains[k]].typical_hi * std::cos(angle);
      }
    }
  return turned;
}

/// Well beside the resonance, where its answer is one of mass and stiffness [rad/s].
double JudgedAt(const EffectInstance& effect) { return 1.7 * 2 * kPi * effect.Value("frequency"); }

/// What `effect` adds to the answer `without` of the shaft at JudgedAt.
Eigen::Matrix2d GainsBeside(const RigParameters& rig, const Eigen::Matrix2cd& without,
                            const EffectInstance& effect) {
  RigParameters with = rig;
  with.effects.push_back(effect);
  const double w0 = 2 * kPi * effect.Value("frequency"), w = JudgedAt(effect);
  const std::complex<double> stiffness(w0 * w0 - w * w, 2 * effect.Value("damping") * w0 * w);
  return ((ShaftAt(with, w) - without) * stiffness).real();
}

/// Whether what shapes the two is nearly the same; their sizes are what the estimate asks for.
bool AlikeInShape(const EffectInstance& a, const EffectInstance& b) {
  const EffectDescription& d = EffectNamed(a.name);
  for (std::size_t k = 0; k < a.table.size(); ++k)
    if (!d.Switches(a.table[k]) && a.values[k] > 0 && b.values[k] > 0 &&
        std::abs(std::log(a.values[k] / b.values[k])) > kApartForms)
      return false;
  return true;
}

/// A resonance of other frequencies along x and y shows as two: the starts, and those whose second
/// frequency is that of another estimate.
std::vector<EffectInstance> WithSplits(const std::vector<EffectInstance>& starts,
                                       const std::vector<ResonanceEstimate>& estimates) {
  std::vector<EffectInstance> out = starts;
  for (const EffectInstance& start : starts)
    for (const ResonanceEstimate& other : estimates) {
      const double ratio = other.frequency / start.Value("frequency");
      EffectInstance split = start;
      SetIfThere(split, "ratio", ratio);
      if (split.values != start.values && std::abs(std::log(ratio)) > kLeastSplit &&
          std::abs(std::log(ratio)) < kMostSplit)
        out.push_back(split);
    }
  return out;
}

}  // namespace

EffectInstance ScaledResonance(const EffectInstance& e, double factor) {
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

Eigen::Matrix2d ResonanceGains(const RigParameters& rig, const EffectInstance& effect) {
  return GainsBeside(rig, ShaftAt(rig, JudgedAt(effect)), effect);
}

std::vector<EffectInstance> ResonanceStarts(const RigParameters& rig, const EffectInstance& null,
                                            const std::vector<ResonanceEstimate>& estimates) {
  std::vector<EffectInstance> out;
  for (const ResonanceEstimate& estimate : estimates) {
    std::vector<std::pair<double, EffectInstance>> fitting;  // gains told, start
    const std::vector<EffectInstance> forms = FormsAt(null, estimate);
    const Eigen::Matrix2cd without = ShaftAt(rig, JudgedAt(forms[0]));
    for (const EffectInstance& form : forms) {
      const Eigen::Matrix2d gains = GainsBeside(rig, without, form);
      const double along = (gains.cwiseProduct(estimate.gains)).sum(), own = gains.squaredNorm();
      if (along > 0 && along * along / own > kResembles * estimate.gains.squaredNorm())
        fitting.emplace_back(along * along / own, ScaledResonance(form, along / own));
    }
    std::stable_sort(fitting.begin(), fitting.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<EffectInstance> kept;
    for (const auto& [told, start] : fitting)
      if (kept.size() < kForEach && std::none_of(kept.begin(), kept.end(), [&](const auto& o) {
            return AlikeInShape(start, o);
          }))
        kept.push_back(start);
    out.insert(out.end(), kept.begin(), kept.end());
  }
  return WithSplits(out, estimates);
}

}  // namespace ambrig
