#pragma once
/// What the tests of published rotors share.
#include <gtest/gtest.h>

#include <vector>

#include "core/math/constants.h"
#include "rotor/shaft/reduction.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

inline const Material kFriswellSteel{211e9, 7810, 211e9 / (2 * 81.2e9) - 1};

inline ShaftSection Uniform(double z0, double length, double od, const Material& m) {
  ShaftSection s;
  s.z0 = z0;
  s.length = length;
  s.od = s.od_right = od;
  s.material = m;
  return s;
}

inline Disk FriswellDisk(double z, double od) { return DiskFromGeometry(z, 0.07, 0.05, od, 7810); }

inline std::vector<double> NaturalFrequencies(const BeamDefinition& d, double speed, int count) {
  std::vector<double> out;
  for (const WhirlMode& m : WhirlModes(Assemble(BuildBeam(d)), speed, count))
    out.push_back(m.omega_n);
  return out;
}

inline void ExpectEach(const std::vector<double>& ours, const std::vector<double>& published,
                       double relative, double absolute = 0) {
  ASSERT_GE(ours.size(), published.size());
  for (std::size_t i = 0; i < published.size(); ++i)
    EXPECT_NEAR(ours[i], published[i], relative * published[i] + absolute) << "number " << i + 1;
}

inline std::vector<double> Hz(const Eigen::VectorXd& omega) {
  std::vector<double> out;
  for (double w : omega) out.push_back(w / (2 * kPi));
  return out;
}

/// Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines, 5.9: shaft 1.5 m, 50 mm.
inline BeamDefinition FriswellShaft(int elements) {
  BeamDefinition d;
  d.sections = {Uniform(0, 1.5, 0.05, kFriswellSteel)};
  d.elements_per_section = elements;
  return d;
}

}  // namespace ambrig
