#pragma once
/// A contact with something on one side of the rotor, found in samples of the force that a model
/// lacks.
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "discovery/decision/missing_force.h"

namespace ambrig {

/// A contact from one side:
///   f = -k max(along + lobe cos(theta - high) - gap, 0) (n + mu Rubs(v) t)
/// n: direction of the contact, t: across it in the direction of rotation, v: speed of sliding. It
/// acts always, or during a part of every period. The lobe is the rotor's high spot.
struct SideContact {
  static constexpr double kSlow = 0.01;  // [m/s], as in docs/theory/base_model.md section 8

  // [rad], [m], [s], -, -, [m], [rad]
  double angle = 0, gap = 0, period = 0, phase = 0, duty = 1, lobe = 0, high = 0;
  double share = 0;           // of the force's power that it explains
  double push = 0, drag = 0;  // k and mu k [N/m]

  /// Friction of the sample number k, as a part of the full one against +t.
  double Rubs(const ForceSamples& s, std::size_t k) const {
    const double v = s.radius * s.omega[k] - std::sin(angle) * s.vx[k] + std::cos(angle) * s.vy[k];
    return v / std::sqrt(v * v + kSlow * kSlow);
  }
  double Least() const { return std::cos(kPi * duty); }  // of the cosine where the bump begins
  double On(double t) const {
    return period <= 0
               ? 1
               : std::max(0.0, std::cos(2 * kPi * (t / period - phase)) - Least()) / (1 - Least());
  }
};

/// The contact that explains most; one that comes and goes must explain `much` more of the power.
SideContact FindSideContact(const ForceSamples& samples, double much);

}  // namespace ambrig
