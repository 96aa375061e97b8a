#pragma once
/// Axial and torsional modes of a shaft:
///   axial      rho A u'' = (E A u')',      disks and point masses, supports by kzz, housings by
///   mass_z torsional  rho J phi'' = (G J phi')',  disks by their polar inertia; supports by krz
/// with rods of three nodes and quadratic displacement, one per element of the beam, A and J along
/// tapers integrated: frequencies converge with the fourth power of the element length. Supports as
/// they are at one speed, without damping.
#include <vector>

#include "rotor/shaft/beam.h"

namespace ambrig {

struct RodMode {
  double omega = 0;           // [rad/s]
  std::vector<double> shape;  // at the nodes of the beam, largest 1
};

/// The lowest `count` each; rigid motions (omega = 0) left out.
std::vector<RodMode> AxialModes(const BeamRotor& beam, double speed, int count);
std::vector<RodMode> TorsionalModes(const BeamRotor& beam, double speed, int count);

}  // namespace ambrig
