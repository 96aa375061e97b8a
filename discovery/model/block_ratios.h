#pragma once
/// Which block of the model is wrong: each with measured inputs beside its measured outputs.
#include "discovery/model/blocks.h"
#include "discovery/model/case_model.h"

namespace ambrig {

/// Errors of the data over errors of the model's own noisy record, block by block: 1 means the
/// block explains its part.
BlockErrors BlockRatios(const CaseModel& model, const Hypothesis& h, std::size_t record);

}  // namespace ambrig
