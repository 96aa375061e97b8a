#pragma once
/// A sum of relaxations in series with a gap, as a law of the iron:
///
///   M = Σ e_k + tail φ' + rest φ,   e_k' = w_k φ' - p_k e_k
///
/// At rest only `rest` is left.
#include <memory>

#include "actuators/magnetics/flux_law.h"

namespace ambrig {

template <int kPoles>
struct Relaxations {
  double pole[kPoles] = {}, weight[kPoles] = {};  // p_k [rad/s], w_k [1/H]
  double tail = 0, rest = 0;                      // [s/H], [1/H]
};

std::unique_ptr<FluxLaw> MakeRelaxationLaw(const Relaxations<8>& relaxations);
std::unique_ptr<FluxLaw> MakeRelaxationLaw(const Relaxations<10>& relaxations);

}  // namespace ambrig
