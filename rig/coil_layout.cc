#include "rig/coil_layout.h"

#include <fmt/format.h>

#include "core/base/coil_name.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

std::vector<CoilPlace> CoilsOf(const BearingParameters& b) {
  const StatorGeometry stator = b.kind->stator(b);
  const std::vector<double> angles = stator.Angles();
  std::vector<CoilPlace> coils;
  for (int k = 0; k < b.coils(); ++k)
    coils.push_back({CoilName(b.name, k), angles[static_cast<std::size_t>(k)], stator.n[k],
                     stator.gap_offset[k]});
  return coils;
}

}  // namespace ambrig
