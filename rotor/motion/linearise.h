#pragma once
/// A moving rotor as linear equations (rotor/linear/linear_rotor.h).
#include "rotor/linear/linear_rotor.h"
#include "rotor/motion/rotor_model.h"

namespace ambrig {

/// A rotor as the engines run it, straight and centred, no contact, its force terms (effects)
/// differentiated there; what they push while nothing moves (unbalance) is left out. No ports.
/// `speed` [rad/s] matters for terms that depend on it; G is to be multiplied by it by the reader.
LinearRotor Linearise(const RotorModel& model, double speed = 0);

/// Displacement (x, y) of a plane as rows over the model's coordinates (2 x dofs).
Eigen::MatrixXd PlaneRows(const RotorModel& model, const PlaneMap& plane);

/// How a force (fx, fy) of the stator at a plane enters (dofs x 2), its reaction on a base
/// included.
Eigen::MatrixXd ForceColumns(const RotorModel& model, const PlaneMap& plane);

}  // namespace ambrig
