#pragma once
/// Position readings of one plane: shaft-centre displacement at the sensor's own z, through a chain
/// of reading maps (sensor effects and faults), plus noise. Source: docs/theory/base_model.md
/// section 4.
#include <memory>
#include <vector>

#include "rotor/linear/force_term.h"

namespace ambrig {

/// Seam of the sensors: changes the reading (x, y) of a plane [m]. Called once per switching period
/// in order of time, so a map may keep a filter's state.
class ReadingMap {
 public:
  virtual ~ReadingMap() = default;
  virtual void Map(const MotionState& state, double* x, double* y) = 0;
  // What a linear model asks of a map.
  /// Whether it only adds what does not depend on where the shaft is (run-out, pick-up).
  virtual bool signal() const { return false; }
  /// Time constant of a map that is a first-order lag [s]; 0: a map without memory.
  virtual double lag() const { return 0; }
};

/// A fault of one axis' sensor: offset, stuck at its last value, or lost (reads 0).
struct SensorFault {
  double offset = 0;
  bool stuck = false, lost = false;
  double held = 0;
  double Apply(double reading) const { return lost ? 0 : (stuck ? held : reading + offset); }
};

struct PositionSensor {
  PlaneMap map;
  double noise = 0;  // [m rms]
  std::vector<std::unique_ptr<ReadingMap>> maps;
  SensorFault fault[2];
  double reading[2] = {0, 0};  // before noise
};

}  // namespace ambrig
