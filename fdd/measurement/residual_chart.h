#pragma once
/// The control chart of one bearing's coils: residuals of both phases over their expected size, and
/// CUSUMs  G <- max(0, G + min(|z|, cap) - drift)  of z_on, z_off and (z_on - z_off)/√2.
/// All coils at once, one lane each; masks are 1 or 0.
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

/// Where a residual counts.
inline constexpr double kFewestSamples = 4;  // of a phase

struct ChartSettings {
  double current_noise = 0.004;  // [A rms] per sample, quantisation included
  double adc_limit = 10;         // [A] larger readings are clipped
  double voltage_sd = 0.2;       // bus, drops [V]
  double drift = 2.5, threshold = 9, cap = 12;
};

/// What is known of the nominal model's error: leakage [H] and gap (relative), and what the
/// variance of a residual owes to what is not known of them (coefficients of di², -di flux, flux²).
struct ModelError {
  double leakage = 0, gap = 0;
  double uncertainty[3] = {0, 0, 0};
};

/// Linkages at the last sample of one period and the first of the next [Wb], the voltage between
/// them [V]; the noise of such a step is `noise` [A/s] times the inductance, and at least `floor`
/// [V].
struct LinkageStep {
  const Lane *before, *after, *expected;
  double per_second, noise, floor;
};

struct ResidualChart {
  Lane e[2], sd[2], z[2];  // corrected residual, its expected size [V], their ratio
  Lane per_sd[2];          // 1/sd [1/V]
  Lane valid[2];           // the residual's equation holds
  Lane size[2];            // long-term mean of |z|
  Lane G[3];
  Lane own;  // self-inductance [H]

  /// Residuals of one period. `watched`: coils that may be judged; `uncertainty`: what the motion
  /// may add to the residuals of both phases [V], nullptr: nothing; `potential_rate` [A/s]: by how
  /// much the rotor's potential may be wrong, over the period (unknown ampere-turns).
  void Compute(const LinkageModel& m, const SamplingSettings& sampling, const ChartSettings& s,
               const ModelError& known, const PeriodSlopes& slopes, const Lane& watched,
               const Lane* uncertainty, double potential_rate);
  /// Adds the period; returns the largest G.
  double Cusum(const ChartSettings& s);
  /// Whether any linkage may step by more than `limit` times its noise, beyond what is expected.
  bool Steps(const LinkageStep& step, double limit) const;
  double LargestSum() const;
  double LargestResidual() const;  // |z|
};

}  // namespace ambrig
