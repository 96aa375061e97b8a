#pragma once
/// Fits the circuit and the coils of a healthy bearing to its commissioning run.
///
///   min sum w^2 (gain M0 slope(s psi) + L slope(i) + R mean(i) - v)^2 + priors
///
/// Coil by coil the equation is linear in gain, L and R, with priors at the nominal values; the
/// circuit (dx, dy, path, fringing, four residues; two knee terms; run-out) is
/// found by Gauss-Newton round that, by finite differences, with Levenberg's damping and Huber's
/// weights. Neither phase has a free offset: the bridge's voltage hardly varies, and with one the
/// fit explains the voltage by the offset, with a superb residual and a blind detector. The knee
/// terms are kept only where the cost falls by 2 %: high powers of the flux extrapolate wildly.
/// Run-out is sought where the rest leaves much, of a shaft that turned, and kept where the cost
/// falls by 30 %.
#include "fdd/learning/commissioning_rows.h"

namespace ambrig {

/// `name` of the bearing. A log without usable rows gives a bearing that is not learnt. The healthy
/// running that the bands stand on is added by AddHealthyBands (healthy_bands.h).
CommissionedBearing FitCommissioning(const std::string& name, const LinkageModel& nominal,
                                     const SamplingSettings& sampling,
                                     const ExcessSettings& settings, const CommissioningLog& log);

}  // namespace ambrig
