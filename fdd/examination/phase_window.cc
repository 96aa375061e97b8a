#include "fdd/examination/phase_window.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fdd/measurement/motion_uncertainty.h"
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

namespace {

/// N phi_j at every sample from the other coils' equations. [Wb]
void FluxFromOthers(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p,
                    const PeriodSlopes& now, int j, double* flux) {
  const int count = s.sampling.samples;
  const double h = s.sampling.step;
  std::array<bool, kLanes> conducts{};
  Lane phi0, charge;
  double top = 0, total = 0;
  for (int k = 0; k < m.coils; ++k) {
    double least = 1e30;
    for (int q = 0; q < count; ++q) least = std::min(least, p.adc[static_cast<std::size_t>(q)][k]);
    conducts[static_cast<std::size_t>(k)] =
        k != j && least > kZeroCurrent && now.largest[k] < s.adc_limit;
    top += now.permeance.middle[k] * m.n[k] * p.adc[0][k];
    total += now.permeance.middle[k];
  }
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  for (int k = 0; k < m.coils; ++k) {
    const double partner = m.coupling == Coupling::kSides ? m.n[k ^ 1] * p.adc[0][k ^ 1] : 0;
    phi0[k] =
        now.permeance.middle[k] * (m.n[k] * p.adc[0][k] + partner - (radial ? top / total : 0));
  }
  for (int q = 0; q < count; ++q) {
    const Lane& i = p.adc[static_cast<std::size_t>(q)];
    const double t = q * h;
    Lane phi;
    double U = 0, known = 0, sum = 0;
    for (int k = 0; k < m.coils; ++k) {
      if (q > 0) charge[k] += 0.5 * h * (i[k] + p.adc[static_cast<std::size_t>(q - 1)][k]);
      if (!conducts[static_cast<std::size_t>(k)]) continue;
      const double driven = now.phase[0].voltage[k] * std::min(t, now.edge[k]) +
                            now.phase[1].voltage[k] * std::max(t - now.edge[k], 0.0);
      phi[k] =
          phi0[k] +
          (driven - m.resistance[k] * charge[k] - m.leakage[k] * (i[k] - p.adc[0][k])) / m.n[k];
      U += m.n[k] * i[k] - phi[k] / now.permeance.middle[k];
      known += 1;
      sum += phi[k];
    }
    if (m.coupling == Coupling::kNone ||
        (m.coupling == Coupling::kSides && !conducts[static_cast<std::size_t>(j ^ 1)])) {
      const double partner = m.coupling == Coupling::kSides ? m.n[j ^ 1] * i[j ^ 1] : 0;
      flux[q] = m.n[j] * now.permeance.middle[j] * (m.n[j] * i[j] + partner);
    } else if (m.coupling == Coupling::kSides) {
      flux[q] = m.n[j] * phi[j ^ 1];
    } else {
      if (known > 0) U /= known;
      for (int k = 0; k < m.coils; ++k)
        if (k != j && !conducts[static_cast<std::size_t>(k)])
          sum += now.permeance.middle[k] * (m.n[k] * i[k] - U);
      flux[q] = -m.n[j] * sum;
    }
  }
}

}  // namespace

double SlopeOf(const double* y, int from, int count, double step) {
  double top = 0, bottom = 0;
  const double middle = 0.5 * (count - 1);
  for (int k = 0; k < count; ++k) {
    top += (k - middle) * y[from + k];
    bottom += (k - middle) * (k - middle);
  }
  return top / (bottom * step);
}

void AddWindows(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p, int j,
                std::vector<PhaseWindow>* out) {
  if (!p.in.comparable) return;
  PeriodSlopes now;
  ComputePeriodSlopes(m, s.sampling, p.in, &now);
  Lane uncertainty[2];
  if (p.in.uncertainty.any()) ResidualUncertainty(m, now, p.in.uncertainty, uncertainty);
  double flux[64];
  FluxFromOthers(m, s, p, now, j, flux);
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  const double own = m.SelfInductance(j, now.permeance.middle, radial ? now.permeance.total : 1);
  for (int q = 0; q < 2; ++q) {
    const PhaseSlopes& a = now.phase[q];
    const int count = static_cast<int>(a.samples[j]),
              from = q == 0 ? 0 : static_cast<int>(now.phase[0].samples[j]);
    if (count < 4 || now.largest[j] >= s.adc_limit) continue;
    PhaseWindow w;
    w.phase = q;
    w.v = a.voltage[j];
    w.v_other = now.phase[1 - q].voltage[j];
    w.e = a.residual[j];
    w.F = SlopeOf(flux, from, count, s.sampling.step);
    w.x_l = m.leakage[j] * a.current[j];
    w.x_r = m.resistance[j] * a.mean[j];
    w.own = own * a.current[j];
    w.mean = a.mean[j];
    w.least = a.least[j];
    // [A/s]
    const double per_amp = std::sqrt(SlopeVariance(count, s.sampling.step)) * s.current_noise;
    const double shared = a.linkage[j] - w.x_l;
    const double leak = s.leakage_sd * a.current[j];
    w.noise_l = per_amp * m.leakage[j];
    w.noise_own = per_amp * own;
    w.sd_e = std::sqrt(std::pow(own * per_amp, 2) + std::pow(s.gap_sd * shared, 2) + leak * leak +
                       s.voltage_sd * s.voltage_sd + uncertainty[q][j] * uncertainty[q][j]);
    w.sd_f = std::sqrt((m.coils - 1) * w.noise_l * w.noise_l + std::pow(0.01 * w.F, 2) +
                       s.leakage_sd * s.leakage_sd * 4e8 + s.voltage_sd * s.voltage_sd);
    out->push_back(w);
  }
}

}  // namespace ambrig
