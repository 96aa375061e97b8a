#pragma once
/// What the equations of a bearing's coils lose when the shaft's motion is known only within
/// bounds: at an impact the sampled position lags behind.
///
/// With λ_j = n_j P_j (n_j i_j - U) the velocity v and the position x enter dλ_j/dt as
///
///   λ_j v/g_j - n_j P_j dU/dt,  |dU/dt| <= Σ_k |λ_k/n_k| v/g_k / Σ P        (floating rotor)
///   (dλ_j/dt) x/g_j
///
/// so that |e_j| may reach (|λ_j|/g_j + |n_j| P_j Σ_k |λ_k/n_k|/g_k / Σ P) δv + |slope(λ_j)|
/// δx/g_j, to first order. Source: docs/theory/base_model.md section 2.
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

/// By how much each coil's residual may be wrong in both phases [V].
void ResidualUncertainty(const LinkageModel& m, const PeriodSlopes& slopes,
                         const MotionUncertainty& uncertainty, Lane out[2]);

/// By how much each coil's linkage may be wrong when the position is [Wb].
Lane LinkageUncertainty(const LinkageModel& m, const PeriodSlopes& slopes, double position);

}  // namespace ambrig
