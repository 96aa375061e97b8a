#pragma once
/// Rows of a record that no model predicts: instants at which noise far below the measurement's
/// decides what happens next, such as a current that ends just before or just after a switching
/// edge. Neither a misfit there nor a sensitivity means anything.
#include <vector>

namespace ambrig {

class CaseModel;

/// Samples `first` to `last` of a record's data, both included.
struct SampleSpan {
  std::size_t record = 0, first = 0, last = 0;
};

/// Spans that touch or overlap are one; sorted by record and instant.
std::vector<SampleSpan> MergedSpans(std::vector<SampleSpan> spans);

/// Where one of two noisy predictions departs from the clean one by more than five times the robust
/// sd (median absolute deviation) of its channel, 0.5 ms before and after included, sorted by
/// record and instant. A channel that does so in more than one row of fifty is noisy in parts, not
/// unpredictable at instants: none of its rows is in a span. `d1`, `d2`: noisy minus clean, all
/// rows of the model.
std::vector<SampleSpan> UnpredictableRows(const CaseModel& model, const std::vector<double>& d1,
                                          const std::vector<double>& d2);

}  // namespace ambrig
