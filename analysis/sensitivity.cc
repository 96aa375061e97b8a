#include "analysis/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "analysis/closed_loop_modes.h"
#include "analysis/iso14839.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

/// Where a linear interpolation between two values is zero, as a fraction.
double Crossing(double a, double b) { return a / (a - b); }

/// Gains at which L touches -1: crossings of the negative real axis, |L| above or below one.
void GainMargins(const std::vector<Complex>& L, AxisSensitivity& s) {
  s.gain_up = kInfinity;
  s.gain_down = 0;
  for (std::size_t k = 1; k < L.size(); ++k) {
    if (L[k - 1].imag() * L[k].imag() > 0) continue;
    const double t = Crossing(L[k - 1].imag(), L[k].imag());
    const double real = std::lerp(L[k - 1].real(), L[k].real(), std::isfinite(t) ? t : 0.0);
    if (real >= 0) continue;
    const double factor = -1 / real;
    if (factor > 1)
      s.gain_up = std::min(s.gain_up, factor);
    else
      s.gain_down = std::max(s.gain_down, factor);
  }
}

void PhaseMargins(const std::vector<double>& f, const std::vector<Complex>& L, AxisSensitivity& s) {
  s.phase_margin = s.delay_margin = kInfinity;
  for (std::size_t k = 1; k < L.size(); ++k) {
    const double a = std::log(std::abs(L[k - 1])), b = std::log(std::abs(L[k]));
    if (a * b > 0 || a == b) continue;
    const double t = Crossing(a, b), at = std::lerp(f[k - 1], f[k], t);
    const Complex L_at = L[k - 1] + t * (L[k] - L[k - 1]);
    const double lead = std::arg(-L_at);  // ahead of -180 degrees
    if (std::abs(lead) < s.phase_margin) {
      s.phase_margin = std::abs(lead);
      s.phase_frequency = at;
    }
    // A dead time turns L clockwise: the way to -1 is `lead` when positive, else a turn more.
    const double turn = lead > 0 ? lead : lead + 2 * kPi;
    s.delay_margin = std::min(s.delay_margin, turn / (2 * kPi * at));
  }
}

}  // namespace

Sensitivity FindSensitivity(const OperatingPoint& point, const TransferFunction& transfer,
                            double rated) {
  const ClosedLoop& loop = transfer.loop();
  const double nyquist = 0.5 / loop.Ts(), highest = SensitivityRange(rated / (2 * kPi));
  const bool stable = IsStable(transfer.eigenvalues().cwiseAbs().maxCoeff());
  Sensitivity out;
  out.speed = loop.speed();
  out.stable = stable;
  out.frequency = FrequencyGrid(transfer, 0.5, 0.98 * nyquist, 400);
  const auto names = point.Axes();
  for (const std::string& name : names) {
    out.axes.emplace_back();
    out.axes.back().axis = name;
  }
  std::vector<Eigen::MatrixXcd> S;  // of all axes together
  for (double f : out.frequency) {
    const Eigen::MatrixXcd H = transfer(2 * kPi * f);
    S.push_back(H.block(loop.Command(0), loop.Excitation(0), loop.axes(), loop.axes()));
    for (std::size_t a = 0; a < names.size(); ++a) {
      const auto k = static_cast<Eigen::Index>(a);
      out.axes[a].S.push_back(H(loop.Command(k), loop.Excitation(k)));
    }
  }
  for (AxisSensitivity& s : out.axes) {
    std::vector<Complex> L;
    double off = 0;
    for (std::size_t k = 0; k < s.S.size(); ++k) {
      off = std::max(off, std::abs(s.S[k] - 0.5));
      L.push_back(1.0 / s.S[k] - 1.0);
      if (out.frequency[k] > highest || std::abs(s.S[k]) <= s.peak) continue;
      s.peak = std::abs(s.S[k]);
      s.peak_frequency = out.frequency[k];
    }
    s.zone = stable ? SensitivityZone(s.peak) : 'D';  // a peak of what diverges means nothing
    s.disk_margin = stable ? 1 / off : 0;
    GainMargins(L, s);
    PhaseMargins(out.frequency, L, s);
  }
  if (stable) out.joint = FindJointMargins(out.frequency, S);
  return out;
}

}  // namespace ambrig
