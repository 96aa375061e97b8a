#pragma once
#include "discovery/model/blocks.h"
#include "discovery/model/model.h"

namespace ambrig {

/// Errors of the data over errors of the model's own noisy record, block by block: 1 means the
/// block explains its part.
BlockErrors BlockRatios(const CaseModel& model, const Hypothesis& h, std::size_t record);

}  // namespace ambrig
