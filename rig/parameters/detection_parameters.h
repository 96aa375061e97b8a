#pragma once
/// [detection] of a rig file: which detector of coil faults watches the rig in a run. The names of
/// the detectors are those of fdd/detectors/detector_catalogue.cc, which checks `kind` when a run
/// begins.
#include <string>

#include "core/base/parameters.h"

namespace ambrig {

/// The detector where a rig file names none: it does no harm to healthy machines that are not their
/// model, watches stators of every kind, and is the one that a commissioning is for.
inline constexpr const char* kCommissionedDetector = "commissioned";

struct DetectionParameters {
  std::string kind = kCommissionedDetector;
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
