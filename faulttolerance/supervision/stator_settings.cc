#include "faulttolerance/supervision/stator_settings.h"

#include <fmt/format.h>

#include "rig/parameters/bearing_kind.h"

namespace ambrig {

void CheckWhatStatorsAllow(const RigParameters& rig, const BearingParameters& b,
                           const std::string& redistribution) {
  if (!b.kind->linearise) return;
  if (redistribution == "force-by-force")
    throw InputError(
        fmt::format("{}: redistribution = \"force-by-force\" with bearing {} of kind "
                    "\"{}\", allowed: auto, matrix",
                    rig.file, b.name, b.kind->name));
  if (rig.detection.kind != kCommissionedDetector)
    throw InputError(fmt::format(
        "{} = \"{}\" with bearing {} of kind \"{}\", allowed: {} (such a stator is "
        "watched by the balance of its linkages)",
        rig.detection.where, rig.detection.kind, b.name, b.kind->name, kCommissionedDetector));
}

}  // namespace ambrig
