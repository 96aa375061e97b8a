/// Slopes of a period when the ampere-turns of some coils are not known (period_slopes.h).
#include <algorithm>

#include "fdd/measurement/slope_fit.h"

namespace ambrig {

void ComputePeriodSlopesUnknownMmf(const LinkageModel& m, const SamplingSettings& s,
                                   const MeasuredPeriod& in,
                                   const std::array<bool, kLanes>& excluded, PeriodSlopes* out) {
  Lane first, charge;
  PreparePeriod(m, s, in, out);
  SlopeSums& sum = out->sums = {};
  std::array<bool, kLanes> usable{};
  for (int j = 0; j < m.coils; ++j) {
    double least = 1e30;
    for (int k = 0; k < s.samples; ++k) least = std::min(least, in.adc[k][j]);
    usable[static_cast<std::size_t>(j)] = !excluded[static_cast<std::size_t>(j)] && least > 0.03;
  }
  for (int j = 0; j < kLanes; ++j) {
    out->phase[0].least[j] = out->phase[1].least[j] = 1e30;
    out->largest[j] = -1e30;
  }
  for (int k = 0; k < s.samples; ++k) {
    Lane P, lambda;
    double top = 0, total = 0;
    for (int j = 0; j < m.coils; ++j) {
      P[j] = out->permeance.start[j] + out->permeance.change[j] * k / s.samples;
      top += P[j] * m.n[j] * in.adc[k][j];
      total += P[j];
    }
    double share = 0, weight = 0;
    for (int j = 0; j < m.coils; ++j) {
      const double i = in.adc[k][j], t = k * s.step, edge = out->edge[j];
      lambda[j] = m.n[j] * P[j] * (m.n[j] * i - top / total) + m.leakage[j] * i;
      if (k > 0) charge[j] += 0.5 * s.step * (i + in.adc[k - 1][j]);
      if (!usable[static_cast<std::size_t>(j)]) continue;
      const double driven = out->phase[0].voltage[j] * std::min(t, edge) +
                            out->phase[1].voltage[j] * std::max(t - edge, 0.0);
      const double error = lambda[j] + m.resistance[j] * charge[j] - driven;
      if (k == 0) first[j] = error;
      share += m.n[j] * P[j] * (error - first[j]);
      weight += m.n[j] * m.n[j] * P[j] * P[j];
    }
    const double dU = weight > 0 ? share / weight : 0;  // error of -U since the first sample
    for (int j = 0; j < m.coils; ++j) {
      const double i = in.adc[k][j], y = lambda[j] - m.n[j] * P[j] * dU;
      const bool on = k < out->phase[0].samples[j];
      if (k == 0) out->first[j] = y;
      if (k == s.samples - 1) out->last[j] = y;
      sum.y[j] += y;
      sum.ky[j] += k * y;
      sum.i[j] += i;
      sum.ki[j] += k * i;
      out->largest[j] = std::max(out->largest[j], i);
      double& least = out->phase[on ? 0 : 1].least[j];
      least = std::min(least, i);
      if (!on) continue;
      sum.y_on[j] += y;
      sum.ky_on[j] += k * y;
      sum.i_on[j] += i;
      sum.ki_on[j] += k * i;
    }
  }
  FitSlopes(m, s, out);
}

}  // namespace ambrig
