#pragma once
/// What the measurement noise alone would do to every channel: it goes round the control loop, so
/// the model is run with noise seeds and compared with its noise-free run.
#include "discovery/model/case_model.h"

namespace ambrig {

struct NoiseFloor {
  double effective_sample_size = 0;  // independent numbers among all residuals (they are coloured)
  std::vector<double> clean;         // the noise-free prediction that was used
  std::vector<SampleSpan> unpredictable;  // left out of the model
};

/// Sets the floor of every target (rms), leaves out what is unpredictable (unpredictable_rows.h),
/// and returns the effective count. A channel that noise does not reach gets the resolution of what
/// measured it.
NoiseFloor FindFloor(CaseModel& model, const Hypothesis& h);

/// Rows of a coloured series per independent one: 1 + 2 Σ ρ² over the lags up to 200 and a quarter
/// of the rows.
double RowsPerIndependentOne(const std::vector<double>& v, std::size_t first, std::size_t count);

}  // namespace ambrig
