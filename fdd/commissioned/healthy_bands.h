#pragma once
/// How far the healthy bearing of a commissioning run came from the model that was learnt on it:
/// what bands and the commissioned range stand on.
#include "fdd/commissioned/commissioned_detector.h"
#include "fdd/learning/commissioning_log.h"

namespace ambrig {

/// Fills largest, largest_flux, current_error and pattern of `bearing`.
void AddHealthyBands(const CoilDetectorSetup& setup, const CommissioningLog& log,
                     CommissionedBearing* bearing);

}  // namespace ambrig
