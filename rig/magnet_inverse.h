#pragma once
/// Currents that give a force where the rotor is: the inverse of the nominal magnets with ideal iron. From the
/// currents of the bias-current map, steps of least norm onto F(i, r) = f, then into the amplifiers' range.
#include "control/position/controller_kind.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// Of a bearing of any kind. `weight`: its share of it, where k_s is taken [N].
MagnetInverse MagnetInverseOf(const NominalRig& rig, std::size_t bearing,
                              const Eigen::Vector2d& weight);

}  // namespace ambrig
