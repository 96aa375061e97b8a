#pragma once
/// Several coils of one bearing with shorted turns at once. coil_examination.h tells the fault of
/// one coil from the flux that all others report; with two of them wrong it blames a current in the
/// shorted turns and takes half a winding for one turn. Here all coils are judged together:
///
///   a_j² A_j - a_j Σ_k a_k B_jk + a_j R_j mean(i_j) = v_j,   both phases, every coil that conducts
///
/// with A_j = slope(n_j² P_j i_j + L_j i_j), B_jk = slope(n_j P_j n_k P_k i_k / Σ P) and the share
/// a_j of the model's turns that is left: nonlinear least squares over residuals of known size,
/// then the fewest coils that explain them. Turns that are bypassed (published_values.md 1: L -> a²
/// L, R -> a R); a closed loop of shorted turns carries a current of its own and fits no a. A coil
/// without current (open) adds no equation and no flux, so shorts are found beside it.
#include <vector>

#include "fdd/measurement/kept_period.h"
#include "fdd/model/linkage_model.h"

namespace ambrig {

struct ShortedCoils {
  std::vector<int> coils;  // two or more, from 0, rising; empty: not the explanation
  Lane turns_left;         // of the model's turns, 1 elsewhere
  double confidence = 0;   // probability that each of them is needed, 0..1
};

/// `periods`: all of them after the onset. `judged`: coils whose equation may be used. Radial
/// bearings.
ShortedCoils FindShortedCoils(const LinkageModel& model, const DetectorSettings& settings,
                              const std::vector<const KeptPeriod*>& periods,
                              const std::array<bool, kLanes>& judged);

}  // namespace ambrig
