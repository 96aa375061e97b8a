#pragma once
/// The bridge of one coil, a part of the plant: it turns the duty of a switching period into pieces
/// of constant voltage.
///
///   bi-state   on: +U_d - 2 U_s; off: -(U_d + 2 U_c)
///   tri-state  as bi-state, with freewheeling at -(U_s + U_c)
///   chopper    on: +U_d; off: 0 (freewheel diode ideal)
///   ideal      duty * U_d
///
/// With all switches open the diodes of a full bridge lead the current back into the bus,
/// -(U_d + 2 U_c) against its sign, and block when it has ended; of a chopper it runs out through
/// the freewheel diode.
///
/// Source: docs/theory/base_model.md section 3; [loadcurrentslope] Eq. 1, 5, 11.
#include <algorithm>

#include "actuators/electronics/coil_voltage.h"

namespace ambrig {

/// What an effect or a fault may change of one coil's bridge.
struct BridgeImperfection {
  double dead_time = 0;       // [s] both switches wait before they turn on
  double freewheel_drop = 0;  // [V] chopper: the coil sees -drop while the switch is off
  double voltage_offset = 0;  // [V] constant error
  double dead_duty = 0;       // [-] duty below which nothing comes out
  double late_edge = 0;       // [s] the end of the on-phase comes so much later
  bool off = false;           // amplifier-off: all switches open
  bool stuck_on = false;      // switch-stuck-on
};

/// The end of an on-phase that comes `late` [s]: `end` of a period of T, which began at `begin`. A
/// bridge that does not switch, at duty 0 or 1, has no edge to move.
inline double LateEnd(double end, double late, double begin, double T) {
  if (late == 0 || end <= 0 || end >= T) return end;
  return std::clamp(end + late, begin, T);
}

class PowerBridge {
 public:
  PowerBridge() = default;
  explicit PowerBridge(const AmplifierParameters& p) : p_(p) {}

  /// Voltages of a period with `duty`. `current` [A]: of the coil at its start; only its sign
  /// counts, and only of a bridge that is off.
  CoilVoltage Pattern(double duty, const BridgeImperfection& imperfection,
                      double current = 0) const;

 private:
  AmplifierParameters p_;
};

}  // namespace ambrig
