#pragma once
/// Working state of one bearing inside the switching engine.
#include <array>

#include "simulation/sampled/sampled_bearing.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

struct SwitchingEngine::BearingRun : SampledBearing {
  int auxiliary = -1;  // index among the rotor's auxiliary planes
  VoltagePattern pattern;
  bool only_edge_moves = false;  // ordinary bi-state bridges: the pattern is set but for t2
  bool plain_sensors = true;
  CurrentStatistics current;      // of the last period
  double x = 0, y = 0;            // magnetic position at the start of the period [m]
  double x_next = 0, y_next = 0;  // predicted for its end
  double max_orbit_sq = 0;        // largest distance of the shaft from the centre, squared [m²]
  std::array<bool, kLanes> faulty{};

  /// The shaft's centre at the magnets' plane.
  void MoveTo(const PlanePoint& p) {
    true_x = p.x;
    true_y = p.y;
    x = p.x - plant->offset_x;
    y = p.y - plant->offset_y;
  }
};

}  // namespace ambrig
