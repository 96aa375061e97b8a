#pragma once
/// Parameters of the position sensors of one plane.
#include "core/base/parameters.h"

namespace ambrig {

struct SensorParameters {
  double z = kRequired;  // a thrust bearing's sensor has none
  double noise = 0;
};

inline constexpr Field<SensorParameters> kSensorFields[] = {
    {"z", &SensorParameters::z, "m", -100, 100, "sensor plane"},
    {"noise", &SensorParameters::noise, "m", 0, 1, "rms of one reading"},
};

}  // namespace ambrig
