#pragma once
/// A shaft that lies still on its supports under its own weight (along -y), that of its disks and
/// point masses, and that of its housings: K u = f with the coefficients of the supports at one
/// speed and the axial forces. Shear V is the sum of all upward forces to the left of a section,
/// the bending moment M its integral from the left end (sagging is positive): from each element's
/// own end forces, exact for loads that the elements take consistently.
#include <string>
#include <vector>

#include "rotor/shaft/beam.h"

namespace ambrig {

struct SupportReaction {
  std::string name;
  double z = 0;           // nan of one that carries a housing
  double fx = 0, fy = 0;  // of the support on what it carries [N]
};

struct StaticDeflection {
  bool held = false;                      // false: the supports leave a motion free
  std::vector<double> z, x, y;            // nodes [m], displacement [m]
  std::vector<double> at, shear, moment;  // both ends of every element [m], [N], [N m]
  std::vector<SupportReaction> reactions;
  double weight = 0;  // of the shaft and what hangs on it [N]
};

inline constexpr double kStandardGravity = 9.80665;  // [m/s2]

StaticDeflection DeflectUnderWeight(const BeamRotor& beam, double speed,
                                    double gravity = kStandardGravity);

}  // namespace ambrig
