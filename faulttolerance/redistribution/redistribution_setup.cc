#include "faulttolerance/redistribution/redistribution_setup.h"

#include <cstdlib>

#include "rig/rig_figures.h"

namespace ambrig {

RedistributionProblem RedistributionProblemOf(const NominalRig& rig,
                                              const BearingParameters& bearing) {
  Require(bearing.kind == BearingKind::kRadial, "a radial bearing");
  const RadialStator stator(bearing.radial);
  RedistributionProblem p;
  for (int j = 0; j < kPoles; ++j) {
    p.angle[j] = std::atan2(stator.sine()[j], stator.cosine()[j]);
    p.sign[j] = stator.sense()[j];
    p.turns_left[j] = 1;
  }
  p.turns = bearing.radial.turns;
  p.pole_area = bearing.radial.pole_area;
  p.gap = bearing.radial.gap;
  p.c0 = BiasCurrent(*rig, bearing);
  p.i_max = rig->amplifier.i_max;
  p.quadrants = static_cast<int>(rig->amplifier.quadrants);
  return p;
}

std::string RedistributionCacheDirectory() {
  if (const char* own = std::getenv("AMBRIG_CACHE")) return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME")) return std::string(xdg) + "/ambrig";
  if (const char* home = std::getenv("HOME")) return std::string(home) + "/.cache/ambrig";
  return "";
}

}  // namespace ambrig
