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

/// When the samples of a period are really taken, of all bearings at the same time.
struct SampleInstants {
  static constexpr int kMost = 64;  // of the parameter's range
  bool exact = true;
  double toward[kMost] = {};  // share of the way to the neighbour; unused where all are exact
  int neighbour[kMost] = {};

  /// `jitter`: rms in steps between two samples; `normals`: of unit variance, one per sample.
  void Set(int samples, double jitter, const float* normals);
};

/// Normals of unit variance, samples x coils, and the instants. Unused without noise.
struct MeasurementErrors {
  const float* readings;
  const SampleInstants& instants;
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
                     bool plain, const MeasurementErrors& errors, Lane* adc,
                     CurrentStatistics* statistics);

}  // namespace ambrig
