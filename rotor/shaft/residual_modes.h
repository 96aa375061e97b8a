#pragma once
/// Residual modes: what keeps the static compliance of a beam of few modes. A force at station z_j
/// bends the beam, beyond its kept modes, by the residual flexibility
///   a_j = sum phi_k phi_k(z_j)/w_k²          over the modes k that are dropped
/// These shapes, one per station, made orthogonal to one another in mass and stiffness, are modes
/// of their own (mass normalised, frequencies above those kept). With them a static force at a
/// station moves the whole beam as it should, and every other station too; no displacement follows
/// a force without a mass in between, so that the negative stiffness of magnets and a sampled
/// controller meet an ordinary oscillator. Their frequencies are no natural frequencies
/// of the shaft. Sources: MacNeal, Computers & Structures 1, 1971; Rubin, AIAA J. 13, 1975; Craig
/// and Chang, NASA CP-2001, 1976.
#include <vector>

#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

struct ReducedRotor;

/// Of the stations [m on the beam's axis], at most as many; fewer where stations bend the beam
/// alike. `all`: the beam with every mode it has, of which the first `kept` are kept.
PlaneModes ResidualModes(const ReducedRotor& all, int kept, const std::vector<double>& stations);

}  // namespace ambrig
