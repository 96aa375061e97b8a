#pragma once
/// Questions about the current map of a radial bearing before and after a redistribution.
#include "control/current/bearing_control.h"
#include "control/current/current_map.h"
#include "faulttolerance/redistribution/distribution_solver.h"

namespace ambrig {

/// Whether the map of `found` gives the force [N] that is asked of it: a linearised one, clamped at
/// zero current, may give another.
bool GivesForce(const Eigen::Vector2d& force, const RedistributionProblem& left,
                const Distribution& found, const CurrentMap& map);

/// The part of a change of stiffness [N/m] with negative eigenvalues: directions in which the new
/// distribution pulls the rotor away more than the healthy bearing would. In the other directions
/// the loop is stiffer than planned and needs no compensation.
Eigen::Matrix2d DestabilisingPart(const Eigen::Matrix2d& change);

/// The force command [N] that set-points [A] of this map came from.
Eigen::Vector2d CommandedForce(const CurrentMap& map, const CoilVector& set_points);
/// The set-points in force, of every coil [A].
CoilVector SetPointsOf(const BearingControl& control);

}  // namespace ambrig
