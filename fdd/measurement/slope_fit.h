#pragma once
/// Pieces of period_slopes.h that both of its routines share: what the bridge does in the period,
/// and least-squares lines from sums over the samples. All coils at once.
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

/// Permeances at both ends, mean and sum for the middle; edges, samples and voltages of the phases.
void PreparePeriod(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                   PeriodSlopes* out);
/// Slopes from the sums.
void FitSlopes(const LinkageModel& m, const SamplingSettings& s, PeriodSlopes* out);

}  // namespace ambrig
