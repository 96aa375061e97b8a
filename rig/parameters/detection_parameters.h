#pragma once
/// [detection] of a rig file: which detector of coil faults watches the rig in a run. The names of
/// the detectors are those of fdd/detectors/detector_catalogue.cc, which checks `kind` when a run
/// begins.
#include <string>

#include "core/base/parameters.h"

namespace ambrig {

struct DetectionParameters {
  // It does no harm to healthy machines that are not their model.
  std::string kind = "commissioned";
  double threshold = 0;       // of the detector's statistic; 0: the catalogue's
  double computing_time = 0;  // [s] from the end of a period to the actions that follow from it
  std::string commissioning;  // file of a commissioned detector, beside the rig file; may be empty
  std::string where = "detection.kind";  // "file:line: detection.kind", for errors
};

inline constexpr Field<DetectionParameters> kDetectionFields[] = {
    {"threshold", &DetectionParameters::threshold, "-", 0, 1e9,
     "of the detector's statistic, in its unit; 0: that of docs/guide/detectors.md"},
    {"computing_time", &DetectionParameters::computing_time, "s", 0, 0.01,
     "from the end of a switching period to the actions that follow from it, in whole periods"},
};

}  // namespace ambrig
