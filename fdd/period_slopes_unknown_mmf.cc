/// Slopes of a period when the ampere-turns of some coils are not known (period_slopes.h).
#include <algorithm>

#include "fdd/slope_fit.h"

namespace ambrig {

void ComputePeriodSlopesUnknownMmf(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                                   const std::array<bool, kLanes>& excluded, PeriodSlopes* out) {
  Lane first, charge;
  SlopeSums sum;
  PreparePeriod(m, s, in, out);
  std::array<bool, kLanes> usable{};
  for (int j = 0; j < m.coils; ++j) {
    double least = 1e30;
    for (int k = 0; k < s.samples; ++k) least = std::min(least, in.adc[k][j]);
    usable[static_cast<std::size_t>(j)] = !excluded[static_cast<std::size_t>(j)] && least > 0.03;
  }
  for (int j = 0; j < kLanes; ++j) {
    sum.least_on[j] = sum.least_off[j] = 1e30;
    sum.largest[j] = -1e30;
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
      const double driven = out->phase[0].voltage[j] * std::min(t, edge) + out->phase[1].voltage[j] * std::max(t - edge, 0.0);
      const double error = lambda[j] + m.resistance[j] * charge[j] - driven;
      if (k == 0) first[j] = error;
      share += m.n[j] * P[j] * (error - first[j]);
      weight += m.n[j] * m.n[j] * P[j] * P[j];
    }
    const double dU = weight > 0 ? share / weight : 0;  // error of -U since the first sample
    for (int j = 0; j < m.coils; ++j) {
      const double i = in.adc[k][j], y = lambda[j] - m.n[j] * P[j] * dU;
      const bool on = k < out->phase[0].samples[j];
      if (k == 0) sum.first[j] = y;
      if (k == s.samples - 1) sum.last[j] = y;
      sum.y[j] += y;
      sum.ky[j] += k * y;
      sum.i[j] += i;
      sum.ki[j] += k * i;
      sum.largest[j] = std::max(sum.largest[j], i);
      double& least = on ? sum.least_on[j] : sum.least_off[j];
      least = std::min(least, i);
      if (!on) continue;
      sum.y_on[j] += y;
      sum.ky_on[j] += k * y;
      sum.i_on[j] += i;
      sum.ki_on[j] += k * i;
    }
  }
  FitSlopes(m, s, sum, out);
}

}  // namespace ambrig
