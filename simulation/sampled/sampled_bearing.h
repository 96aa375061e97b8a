#pragma once
/// One bearing of a run as its sampled side sees it, in every fidelity.
#include <cstddef>

#include "actuators/electronics/current_measurement.h"
#include "effects/plant.h"

namespace ambrig {

struct SampledBearing {
  std::size_t index = 0, first_axis = 0, axes = 2;
  BearingPlant* plant = nullptr;
  MeasurementSettings measurement;
  bool plain_sensors = true;  // gain 1, no offset, not stuck
  Lane late_edge;             // of the bridges in this period [s]
  CurrentStatistics current;  // of the last period
  Lane adc[64];               // measured samples of the last period [A]
  double fx = 0, fy = 0;      // mean force of the last period [N]
  // of the one before it: what a load cell shows inside a burst
  double fx_before = 0, fy_before = 0;
  double true_x = 0, true_y = 0;  // shaft centre at the plane [m]
};

}  // namespace ambrig
