#pragma once
/// Eight stop operators in parallel as a law of the iron (Prandtl-Ishlinskii):
///
///   M = Σ_k tangent_k s_k,   s_k <- clamp(s_k + Δφ, ±radius_k)
///
/// Return-point memory, closed minor loops, no dependence on rate. A run starts on the virgin
/// curve.
#include <array>
#include <memory>

#include "actuators/magnetics/flux_law.h"

namespace ambrig {

inline constexpr int kStops = 8;

/// `radius` [Wb], `tangent` [1/H].
std::unique_ptr<FluxLaw> MakeStopLaw(const std::array<double, kStops>& radius,
                                     const std::array<double, kStops>& tangent);

}  // namespace ambrig
