#pragma once
/// Which fault explains the last periods of one suspected coil? A likelihood-ratio test between
/// hypotheses, each on the coil's own voltage equation, with the flux through its pole taken from
/// the other coils (no use of the suspect's current), so that a false sensor and a winding with
/// fewer turns are told apart:
///
///   F = slope of N phi_j  from Σ phi = 0 and  N dphi_k/dt = v_k - R i_k - L_l di_k/dt, k != j
///   healthy          e = 0                       (nominal residual)
///   open             i = 0
///   amplifier off    e = v_off - v_on in the on phase, until the current has decayed to zero
///   switch stuck on  e = v_on - v_off in the off phase
///   partial short    a F + a² L_l di/dt + a R i = v,  a = 1 - s;  and, unless the shorted turns
///                    carry a current,  a² L_jj di/dt + a (the rest) = v
///   current sensor   F + c (L_l di/dt + R i) = v  and  c L_jj di/dt + the rest = v,  c = 1/gain;
///                    or a reading that stands still;  or all well, but after a step of the reading
///
/// Costs are sums of squares over their variances plus a penalty per free quantity.
#include <vector>

#include "fdd/diagnosis.h"
#include "fdd/measurement/kept_period.h"
#include "fdd/model/linkage_model.h"

namespace ambrig {

struct Examination {
  Diagnosis diagnosis;       // kNone: healthy again
  bool decided = false;      // the best is ahead of all others by a margin
  double cost = 1e30;        // of the best: coils may be compared
  bool closed_loop = false;  // partial short whose shorted turns carry a current
};

/// `periods`: oldest first, the onset among them, the first `calm` of them without any suspicion;
/// `last`: decide now whatever the margin.
Examination ExamineCoil(const LinkageModel& model, const DetectorSettings& settings,
                        const std::vector<const KeptPeriod*>& periods, std::size_t calm, int coil,
                        bool last);

}  // namespace ambrig
