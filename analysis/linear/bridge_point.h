#pragma once
/// One coil's bridge, with its imperfections, at a duty that stands: the mean voltage, and the edge
/// that a change of the duty moves.
#include "actuators/electronics/power_bridge.h"

namespace ambrig {

struct BridgePoint {
  double volts = 0;    // mean over the switching period [V]
  double edge = 0;     // [s] in the period
  double impulse = 0;  // [V s] of linkage per unit of duty, at the edge
  bool whole = false;  // no edge (ideal modulation): impulse is [V] over the whole period
};

BridgePoint BridgeAt(const AmplifierParameters& amplifier, const BridgeImperfection& imperfection,
                     double bus, double duty);

/// The duty between 0 and 1 (ideal modulation: -1 and 1) whose mean voltage is `volts`, or the
/// nearest limit. `guess`: a duty to start from.
double DutyForVoltage(const AmplifierParameters& amplifier, const BridgeImperfection& imperfection,
                      double bus, double volts, double guess);

}  // namespace ambrig
