#pragma once
/// Pieces of period_slopes.h that both of its routines share: what the bridge does in the period,
/// and least-squares lines from sums over the samples. All coils at once.
#include "fdd/period_slopes.h"

namespace ambrig {

/// Sums over the samples k of both phases.
struct SlopeSums {
  Lane y_on, ky_on, y, ky;  // linkage: on phase, whole period
  Lane i_on, ki_on, i, ki;  // current
  Lane least_on, least_off, largest;
  Lane first, last;         // linkage
};

/// Permeances at both ends, mean and sum for the middle; edges, samples and voltages of the phases.
void PreparePeriod(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in, PeriodSlopes* out);
void FitSlopes(const LinkageModel& m, const SamplingSettings& s, const SlopeSums& sums, PeriodSlopes* out);

}  // namespace ambrig
