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
  double jitter = 0;     // rms of the instants, over the time between two samples [-]
  Quantiser quantiser;
};

/// Normals of unit variance: samples x coils of the readings, one per sample of its instant.
/// Unused without noise.
struct MeasurementNormals {
  const float* readings;
  const float* instants;
};

/// Per coil: mean of what was measured; mean square and largest size of the true
/// samples. [A], [A²], [A]
struct CurrentStatistics {
  Lane mean, mean_square, largest;
};

/// True samples -> what the ADC hands over, and the statistics of the period. `plain` says that
/// every sensor is ideal (gain 1, no offset, not stuck). A sample that comes early or late is read
/// on the line to its neighbour on that side.
void MeasureCurrents(const MeasurementSettings& s, const Lane* truth, const CurrentSensor* sensors,
                     bool plain, const MeasurementNormals& normals, Lane* adc,
                     CurrentStatistics* statistics);

}  // namespace ambrig
