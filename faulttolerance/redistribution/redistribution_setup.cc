#include "faulttolerance/redistribution/redistribution_setup.h"

#include <cstdlib>

#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

RedistributionProblem RedistributionProblemOf(const NominalRig& rig,
                                              const BearingParameters& bearing) {
  Require(bearing.kind->eight_poles, "a bearing with eight poles");
  RedistributionProblem p = RedistributionProblemOf(bearing.radial);
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
