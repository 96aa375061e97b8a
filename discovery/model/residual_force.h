#pragma once
/// Unmodelled force, estimated from the measurements alone: magnetic forces from measured
/// currents and positions, accelerations from smoothed measured positions, and the difference.
///   f_missing(plane) = forces that the rigid rotor's motion needs - magnetic forces - weight
///   - loads
#include <optional>
#include <string>
#include <vector>

#include "core/record/record.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// Series of one levitated record, at its rate; band-limited to `cutoff`.
struct ResidualForce {
  struct Plane {
    std::string bearing;
    std::vector<double> fx, fy, x, y, vx, vy;    // [N], [m], [m/s]
    std::vector<double> magnetic_x, magnetic_y;  // [N], from measured currents, same band
  };
  std::vector<double> t, theta, omega;
  std::vector<Plane> planes;  // two radial bearings
};

/// nullopt where the record has no currents and positions of two radial bearings.
std::optional<ResidualForce> EstimateResidualForce(const RigParameters& rig,
                                                   const Scenario& scenario, const Record& data,
                                                   double cutoff = 300);

/// Zero-phase low pass (Gaussian, -3 dB at cutoff) of a series; and its derivatives 0, 1, 2.
std::vector<double> Smooth(const std::vector<double>& y, double rate, double cutoff,
                           int derivative = 0);

}  // namespace ambrig
