#pragma once
/// Bias-current linearisation of any stator: the map from forces to set-points at the centre.
///
///   F(c0 b + δi) = F0 + J δi + ...,   δi = c0 W_v v/c0 with J W_v = k c0 I
///
/// W_v is the smallest that does it (pseudo-inverse of J = dF/di); k is such that the
/// coil that moves most moves by |v|. For eight alternating poles that is [1, cos γ, sin γ]
/// and k = 4 mu0 N² A/g0². Where magnets give the bias, c0 is only a scale: the current that would
/// make their flux density, at most `most`. Source: docs/theory/stators.md.
#include <Eigen/Dense>

#include "actuators/magnetics/pole_network.h"

namespace ambrig {

struct BiasLinearisation {
  double k = 0;                                          // [N/A²]
  double c0 = 0;                                         // [A]
  Eigen::Matrix<double, Eigen::Dynamic, 3> W;            // rows [b_j, w_x, w_y]
  Eigen::Vector3d bias_force = Eigen::Vector3d::Zero();  // of the centred rotor [N]
  /// Smallest singular value of J over its largest, of the directions that it acts in: 0 where the
  /// forces of one are no linear function of the currents.
  double condition = 0;
};

/// `bias`: current of every coil [A]; `axes`: 1 or 2 (of an axial stator x is along the shaft).
BiasLinearisation LineariseAtBias(const PoleNetwork& network, double bias, int axes);

}  // namespace ambrig
