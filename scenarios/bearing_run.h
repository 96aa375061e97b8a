#pragma once
/// Working state of one bearing inside the switching engine.
#include <array>

#include "scenarios/measurement.h"
#include "scenarios/switching_engine.h"

namespace ambrig {

struct SwitchingEngine::BearingRun {
  std::size_t index = 0;
  BearingPlant* plant = nullptr;
  std::size_t first_axis = 0, axes = 2;
  int auxiliary = -1;              // index among the rotor's auxiliary planes
  VoltagePattern pattern;
  bool only_edge_moves = false;    // ordinary bi-state bridges: the pattern is set but for t2
  MeasurementSettings measurement;
  bool plain_sensors = true;
  Lane adc[64];                    // measured samples of the last period [A]
  CurrentStatistics current;       // of the last period
  double x = 0, y = 0;             // magnetic position at the start of the period [m]
  double x_next = 0, y_next = 0;   // predicted for its end
  double fx = 0, fy = 0;           // mean force of the last period [N]
  double fx_before = 0, fy_before = 0;  // of the one before it: what a load cell shows inside a burst
  double true_x = 0, true_y = 0;   // shaft centre at the plane, start of the period [m]
  double max_orbit_sq = 0;         // largest distance of the shaft from the centre, squared [m²]
  std::array<bool, kLanes> faulty{};
};

}  // namespace ambrig
