#pragma once
/// What remains of the statistic in healthy running, over displacement, its speed, and the current.
#include "fdd/commissioned/commissioned_detector.h"
#include "fdd/learning/commissioning_log.h"
#include "simulation/commissioning/commission.h"

namespace ambrig {

std::vector<ExcessScatter> ScatterOf(const CoilDetectorSetup& setup, const CommissioningLog& log,
                                     const CommissionedBearing& bearing);

}  // namespace ambrig
