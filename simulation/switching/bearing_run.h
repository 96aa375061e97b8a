#pragma once
/// Working state of one bearing inside the switching engine, beside what its sampled side holds.
#include "simulation/switching/switching_engine.h"

namespace ambrig {

struct SwitchingEngine::BearingRun {
  SampledBearing* side = nullptr;
  BearingPlant* plant = nullptr;
  VoltagePattern pattern;
  bool only_edge_moves = false;   // ordinary bi-state bridges: the pattern is set but for t2
  double x = 0, y = 0;            // magnetic position at the start of the period [m]
  double x_next = 0, y_next = 0;  // predicted for its end

  /// The shaft's centre at the magnets' plane.
  void MoveTo(const PlanePoint& p) {
    side->true_x = p.x;
    side->true_y = p.y;
    x = p.x - plant->offset_x;
    y = p.y - plant->offset_y;
  }
};

}  // namespace ambrig
