#pragma once
/// The current measurement of one bearing over one period: sensor, noise, ADC, and their mean.
#include <cstdint>

#include "actuators/adc.h"
#include "actuators/stator_lanes.h"

namespace ambrig {

struct MeasurementSettings {
  int samples = 18, coils = 8;
  bool noisy = false;
  double noise = 0;  // [A rms]
  Quantiser quantiser;
};

/// True samples -> what the ADC hands over, and its mean per coil; also sums of i² and the largest i.
/// `plain` says that every sensor is ideal (gain 1, no offset, not stuck).
void MeasureCurrents(const MeasurementSettings& s, const Lane* truth, const CurrentSensor* sensors,
                     bool plain, std::uint64_t seed, std::uint32_t stream, std::uint64_t period,
                     Lane* adc, Lane* mean);

/// Mean of i² and the largest i over the period, per lane, of the true samples.
void CurrentStatistics(const Lane* truth, int samples, Lane* mean_square, Lane* largest);

}  // namespace ambrig
