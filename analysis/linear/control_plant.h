#pragma once
/// The linear plant that a controller of a rig sees, sampled at the controller's period with the
/// exact timing of base_model.md sections 3 and 4: from the force command of one tick to the
/// readings of the next.
///
/// Per switching period, about the levitated equilibrium (bias c0, weight carried), each axis with
/// its own pattern of currents:
///   rotor    q'' = a(q, q', Omega) + sum of (k c0 v + k_s x) at the bearings
///   coils    L v' = u - R v - k_b x'
///   loop     u_n = k_p e + I_n + k_i T e,   e = v_set - v_fb
///
/// v: amplitude of the pattern [A]; k_b: back-EMF constant [V s/m]; u: an impulse of the period's
/// volt-seconds at the mean switching edge; v_fb: mean of the last period's ADC samples. Over M
/// periods the set-points of the last tick act. Of the nominal rig: what the controller
/// knows. Not in it: effects, contact, ripple, clamping; the coupling of the bearing's other
/// current patterns (second order in weight/bias).
#include "analysis/linear/rig_linearization.h"
#include "control/synthesis/sampled_plant.h"

namespace ambrig {

/// `controllers`: the rig as the controller knows it, whose force constants turn forces into
/// set-points; default: `rig`. `axes`: of the rig, in order; other axes get no force and their
/// coordinates must not need any (rigid rotor in z).
/// @throws InputError (`where`) when the axes leave something to fall that they can see.
SampledPlant MakeControlPlant(const RigParameters& rig, const std::vector<std::size_t>& axes,
                              double Omega, const RigParameters* controllers = nullptr,
                              const ShaftWeights& weights = {});

}  // namespace ambrig
