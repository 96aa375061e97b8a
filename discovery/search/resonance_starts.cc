#include "discovery/search/resonance_starts.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "effects/catalogue.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rotor/motion/linear_rotor.h"

namespace ambrig {

namespace {

constexpr int kDirections = 24;  // of two gains, over half a turn
constexpr int kForms = 9;        // of a shape parameter, over somewhat more than its usual range
constexpr double kWider = 1.4;
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

/// The forms at the estimate's frequency whose gains are tried: directions of two gains, values of what
/// shapes them.
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
    if (p.name == "frequency" || p.name == "damping" || p.name == "gyro") continue;
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
  RigParameters with = rig;
  with.effects.push_back(effect);
  const double w0 = 2 * kPi * effect.Value("frequency"), w = 1.7 * w0;
  const std::complex<double> stiffness(w0 * w0 - w * w, 2 * effect.Value("damping") * w0 * w);
  return ((ShaftAt(with, w) - ShaftAt(rig, w)) * stiffness).real();
}

std::vector<EffectInstance> ResonanceStarts(const RigParameters& rig, const EffectInstance& null,
                                            const std::vector<ResonanceEstimate>& estimates) {
  std::vector<EffectInstance> out;
  for (const ResonanceEstimate& estimate : estimates) {
    double most = kResembles * estimate.gains.squaredNorm();
    std::optional<EffectInstance> best;
    for (const EffectInstance& form : FormsAt(null, estimate)) {
      const Eigen::Matrix2d gains = ResonanceGains(rig, form);
      const double along = (gains.cwiseProduct(estimate.gains)).sum(), own = gains.squaredNorm();
      if (along <= 0 || along * along / own <= most) continue;
      most = along * along / own;
      best = ScaledResonance(form, along / own);
    }
    if (best) out.push_back(*best);
  }
  return out;
}

}  // namespace ambrig
