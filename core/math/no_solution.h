#pragma once
/// Thrown where an integrator or a solver gives up on equations that were set up
/// rightly: numbers of a rig or a scenario for which there is no solution within the tolerances. No
/// error of the program.
#include <stdexcept>

namespace ambrig {

struct NoSolution : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ambrig
