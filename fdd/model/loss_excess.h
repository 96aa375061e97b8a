#pragma once
/// What a small loss of turns makes of the relative excess c (slope_excess.h).
#include "fdd/model/linkage_model.h"

namespace ambrig {

/// c over the share of the turns that is lost, to first order, the shaft centred: of the winding
/// that lost them, and of the winding that carries the same flux.
struct LossExcess {
  double own = 2, partner = 0;
};

/// A coil that shares no core: c = 1/(1 - s)^2 - 1, the mutual part of a radial bearing left out.
/// The two windings of a thrust side: with M = n^2 P and the leakage L the voltage v = (2 M + L)
/// di/dt drives both, and a loss eps of one winding adds eps M di/dt to the flux that the model
/// takes both to link, and eps (2 M + 2 L) di/dt to its own error.
LossExcess ExcessOfLoss(const LinkageModel& m, int coil);

}  // namespace ambrig
