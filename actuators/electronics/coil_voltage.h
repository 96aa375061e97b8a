#pragma once
/// The voltage of one coil over a switching period, and what an ideal bridge of given parameters
/// makes of a duty. Detectors and designers compute with the ideal bridge of the nominal rig.
#include "actuators/electronics/amplifier_parameters.h"

namespace ambrig {

/// Voltage of one coil over one period: three pieces, each gain * bus + drop.
struct CoilVoltage {
  double t1 = 0, t2 = 0;       // [s] ends of the first and second piece
  double gain[3] = {0, 0, 0};  // [-]
  double drop[3] = {0, 0, 0};  // [V]
  bool released = false;       // all switches open: the diodes carry the current until it ends
};

/// The pieces of a period with `duty` from a bridge without imperfections.
CoilVoltage IdealBridgeVoltage(const AmplifierParameters& p, double duty);

}  // namespace ambrig
