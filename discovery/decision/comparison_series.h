#pragma once
/// Every sample of a comparison, for plots and programs that do their own.
#include <string>
#include <utility>
#include <vector>

#include "core/record/record.h"
#include "discovery/decision/compare.h"

namespace ambrig {

/// Of each record over time: its name ("record-1" of record-1.h5; made different where two agree)
/// and for each channel NAME that was compared NAME.measured, NAME.model (the channel's SI unit)
/// and NAME.error = (measured - model) over the noise floor [-]; nan where a sample does not count.
/// `model` is the one that was compared, unthinned.
std::vector<std::pair<std::string, Record>> ComparisonSeries(const CaseModel& model,
                                                             const Comparison& comparison);

}  // namespace ambrig
