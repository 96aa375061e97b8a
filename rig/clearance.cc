#include "rig/clearance.h"

#include "rig/bearing_kinds/bearing_kind.h"

namespace ambrig {

double GapOf(const BearingParameters& b) { return b.kind->stator(b).gap_offset[0]; }

double ClearanceOf(const BearingParameters& b) {
  return b.auxiliary ? b.auxiliary->clearance : 0.5 * GapOf(b);
}

}  // namespace ambrig
