#pragma once
/// H-infinity control: the controller that keeps the largest gain from disturbances to errors below
/// gamma.
///
///   inputs   forces at the bearings / force_noise, disturbances of the shaft,
///     readings' noise / sensor_noise
///   outputs  W(z) y with W = (1/position_weight) (s + w_b)/(s + w_b/1e3) sampled,
///     f / force_weight, v of the shaft (plane_weight.h, mode_weight.h)
///
/// W asks for little deviation at rest: below the bandwidth w_b the controller integrates.
/// Synthesis for the sampled plant by two Riccati equations (SLICOT SB10DD), gamma by bisection.
/// Source: Zhou, Doyle, Glover 1996; Green, Limebeer 1995.
#include "control/linear/sampled_plant.h"
#include "core/base/parameters.h"

namespace ambrig {

struct HInfinityParameters {
  double position_weight = 2e-5;
  double bandwidth = 30;
  double force_weight = 20;
  double force_noise = 5;
  double sensor_noise = 1e-6;
  double slack = 1.1;
};

inline constexpr Field<HInfinityParameters> kHInfinityFields[] = {
    {"position_weight", &HInfinityParameters::position_weight, "m", 1e-9, 1,
     "deviation of size 1 above the bandwidth"},
    {"bandwidth", &HInfinityParameters::bandwidth, "rad/s", 1e-3, 1e5,
     "below it deviations weigh more and more: integral action"},
    {"force_weight", &HInfinityParameters::force_weight, "N", 1e-6, 1e9, "force of size 1"},
    {"force_noise", &HInfinityParameters::force_noise, "N", 1e-9, 1e9,
     "disturbing force of size 1, at every bearing"},
    {"sensor_noise", &HInfinityParameters::sensor_noise, "m", 1e-12, 1e-2,
     "reading's error of size 1"},
    {"slack", &HInfinityParameters::slack, "-", 1.001, 100,
     "gamma over the least one found: more is smoother"},
};

struct HInfinityDesign {
  StateSpace controller;   // readings [m] -> forces [N]
  double gamma = 0;        // asked for
  double least_gamma = 0;  // that the bisection found
};

/// @throws InputError (`where`: file and line) when no gamma is found.
HInfinityDesign DesignHInfinity(const SampledPlant& plant, const HInfinityParameters& p,
                                const std::string& where);

/// The plant with its weights, columns (disturbances, those of the shaft, noise, f), rows (W y, f,
/// v, y): what is handed to SLICOT.
StateSpace HInfinityPlant(const SampledPlant& plant, const HInfinityParameters& p);

}  // namespace ambrig
