#pragma once
/// A shaft whose numbers are known by hand: a bar of 1.2 m that hardly bends, with a disk in its
/// middle, on two equal supports.
#include "analysis/shaft/shaft_analysis.h"
#include "core/math/constants.h"

namespace ambrig::testing {

inline constexpr double kJeffcottLength = 1.2;  // [m]

/// Springs of k/2 and dampers of c/2 named "left" and "right", a disk of 10 kg named "disk".
inline BeamFile JeffcottShaft(double k, double c) {
  BeamFile file;
  ShaftSection s;
  s.length = kJeffcottLength;
  s.od = s.od_right = 0.4;
  s.material = {1e13, 1, 0.3};
  file.definition.sections = {s};
  file.definition.elements_per_section = 2;
  file.definition.disks.push_back({kJeffcottLength / 2, 10, 0.5, 0.1, "disk"});
  for (const double z : {0.0, kJeffcottLength}) {
    SpringSupport support = IsotropicSupport(z, k / 2, c / 2);
    support.name = z == 0 ? "left" : "right";
    file.definition.supports.push_back(support);
  }
  file.planes = {{"disk", kJeffcottLength / 2}};
  return file;
}

inline ShaftOptions JeffcottOptions() {
  ShaftOptions o;
  o.lowest = 200;
  o.highest = 400;
  o.fastest = 500;
  o.modes = 4;
  return o;
}

}  // namespace ambrig::testing
