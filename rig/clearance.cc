#include "rig/clearance.h"

#include <cmath>

#include "core/base/parameters.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

double GapOf(const BearingParameters& b) { return b.kind->stator(b).gap_offset[0]; }

double GapOfAxis(const RigParameters& rig, const std::string& axis) {
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& own : b.Axes())
      if (own == axis) return GapOf(b);
  return kInfinity;
}

double ClearanceOf(const BearingParameters& b) {
  return b.auxiliary ? b.auxiliary->clearance : 0.5 * GapOf(b);
}

bool InPole(const BearingParameters& b, double x, double y) { return InPole(b, GapOf(b), x, y); }

bool InPole(const BearingParameters& b, double gap, double x, double y) {
  if (b.kind->two_axes) return std::hypot(x, y) >= gap;
  // one magnet alone: free on the other side
  return x >= gap || (b.coils() > 1 && -x >= gap);
}

}  // namespace ambrig
