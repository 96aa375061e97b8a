#pragma once
/// The current measurement of one bearing over one period: sensor, noise, ADC, and their mean.
#include "actuators/electronics/adc.h"
#include "actuators/magnetics/lane.h"

namespace ambrig {

struct MeasurementSettings {
  int samples = 18, coils = 8;
  bool noisy = false;
  bool one_way = false;  // no current is below zero
  double noise = 0;      // [A rms]
  Quantiser quantiser;
};

/// Per coil: mean of what was measured; mean square and largest of the true samples. [A], [A²], [A]
struct CurrentStatistics {
  Lane mean, mean_square, largest;
};

/// True samples -> what the ADC hands over, and the statistics of the period. `normals` holds
/// samples x coils values of unit variance (unused without noise; see MeasurementNoise). `plain`
/// says that every sensor is ideal (gain 1, no offset, not stuck).
void MeasureCurrents(const MeasurementSettings& s, const Lane* truth, const CurrentSensor* sensors,
                     bool plain, const float* normals, Lane* adc, CurrentStatistics* statistics);

}  // namespace ambrig
