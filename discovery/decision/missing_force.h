#pragma once
/// What the unmodelled force depends on, from all levitated records together: position,
/// velocity, angle of rotation, or contact with something on one side, perhaps only at times; and
/// the law as an [[effect]] "formula" that a user can write into the rig file.
#include <optional>
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

struct MissingForce {
  std::string plane;
  double rms = 0;       // [N], both components
  std::string on;       // in words
  double share = 0;     // of its power that the law explains, 0 to 1
  std::string formula;  // TOML of the effect, values as estimated
};

/// nullopt where no record lets the force of that plane be estimated.
std::optional<MissingForce> DescribeMissingForce(const CaseModel& model, const Hypothesis& h,
                                                 const std::string& plane);

/// The same from samples: positions, velocities and forces of a plane, angle and time.
struct ForceSamples {
  std::vector<double> t, theta, omega, x, y, vx, vy, fx, fy;
  double radius = 0;  // of the journal [m]
};
MissingForce FindLaw(const ForceSamples& samples, const std::string& plane);

}  // namespace ambrig
