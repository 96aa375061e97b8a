#pragma once
/// Currents that give a force where the rotor is: the inverse of the nominal magnets with ideal
/// iron. From the currents of the bias-current map, steps of least norm onto F(i, r) = f, then into
/// the amplifiers' range.
#include "control/interface/controller_kind.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// Force [N] of the nominal magnets along the bearing's axes, over coil currents [A] and place [m].
using MagnetForce =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& i, const Eigen::Vector2d& r)>;
MagnetForce MagnetForceOf(const BearingParameters& b);

/// Of a bearing of any kind. `weight`: its share of it, where k_s is taken [N].
MagnetInverse MagnetInverseOf(const NominalRig& rig, std::size_t bearing,
                              const Eigen::Vector2d& weight);

}  // namespace ambrig
