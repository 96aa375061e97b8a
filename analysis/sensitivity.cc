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

constexpr double kSlowest = 1e-4;  // [Hz] where L of a loop without an integrator is real

/// Frequencies below those that are shown, at which a slow or no integrator decides how far the
/// gain may fall.
std::vector<double> SlowFrequencies(double end) {
  std::vector<double> out;
  for (double f = kSlowest; f < end; f *= 2) out.push_back(f);
  return out;
}

/// Gains at which L touches -1: crossings of the negative real axis, |L| above or below one.
/// Without an integrator L begins on that axis.
void GainMargins(const std::vector<Complex>& L, AxisSensitivity& s) {
  s.gain_up = kInfinity;
  s.gain_down = 0;
  const auto crosses = [&s](double real) {
    if (real >= 0) return;
    const double factor = -1 / real;
    if (factor > 1)
      s.gain_up = std::min(s.gain_up, factor);
    else
      s.gain_down = std::max(s.gain_down, factor);
  };
  if (std::abs(L.front().imag()) < 0.01 * std::abs(L.front().real())) crosses(L.front().real());
  for (std::size_t k = 1; k < L.size(); ++k) {
    if (L[k - 1].imag() * L[k].imag() > 0) continue;
    const double t = Crossing(L[k - 1].imag(), L[k].imag());
    crosses(std::lerp(L[k - 1].real(), L[k].real(), std::isfinite(t) ? t : 0.0));
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
  std::vector<double> all = SlowFrequencies(out.frequency.front());
  std::vector<std::vector<Complex>> slow(names.size());
  for (const double f : all) {
    const Eigen::MatrixXcd H = transfer(2 * kPi * f);
    for (std::size_t a = 0; a < names.size(); ++a) {
      const auto k = static_cast<Eigen::Index>(a);
      slow[a].push_back(1.0 / H(loop.Command(k), loop.Excitation(k)) - 1.0);
    }
  }
  all.insert(all.end(), out.frequency.begin(), out.frequency.end());
  std::vector<Eigen::MatrixXcd> S;  // of all axes together
  for (double f : out.frequency) {
    const Eigen::MatrixXcd H = transfer(2 * kPi * f);
    S.push_back(H.block(loop.Command(0), loop.Excitation(0), loop.axes(), loop.axes()));
    for (std::size_t a = 0; a < names.size(); ++a) {
      const auto k = static_cast<Eigen::Index>(a);
      out.axes[a].S.push_back(H(loop.Command(k), loop.Excitation(k)));
    }
  }
  for (std::size_t a = 0; a < names.size(); ++a) {
    AxisSensitivity& s = out.axes[a];
    std::vector<Complex> L = slow[a];
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
    PhaseMargins(all, L, s);
  }
  if (stable) out.joint = FindJointMargins(out.frequency, S);
  return out;
}

}  // namespace ambrig
