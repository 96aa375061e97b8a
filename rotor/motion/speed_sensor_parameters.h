#pragma once
/// Parameters of the sensor that tells the controllers how fast the shaft turns.
#include "core/base/parameters.h"

namespace ambrig {

struct SpeedSensorParameters {
  double pulses_per_revolution = 0;
  double clock = 0;
  double missed_pulses = 0;
  double lag = 0;
};

inline constexpr Field<SpeedSensorParameters> kSpeedSensorFields[] = {
    {"pulses_per_revolution", &SpeedSensorParameters::pulses_per_revolution, "-", 0, 1e5,
     "teeth of the pulse wheel; 0: an ideal sensor reads the speed itself"},
    {"clock", &SpeedSensorParameters::clock, "s", 0, 1,
     "resolution of the timer that takes the time of a pulse; 0: exact"},
    {"missed_pulses", &SpeedSensorParameters::missed_pulses, "-", 0, 0.5,
     "probability that a pulse is missed"},
    {"lag", &SpeedSensorParameters::lag, "s", 0, 10,
     "time constant of the filter behind the sensor; 0: none"},
};

}  // namespace ambrig
