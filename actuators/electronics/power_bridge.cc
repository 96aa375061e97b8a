#include "actuators/electronics/power_bridge.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

CoilVoltage BridgeVoltage(const AmplifierParameters& p, double duty, const BridgeImperfection& b) {
  const double T = 1 / p.switching_frequency;
  CoilVoltage out;
  const auto piece = [&](int q, double gain, double drop) {
    out.gain[q] = gain;
    out.drop[q] = drop + b.voltage_offset;
  };
  if (b.off) duty = 0;
  if (b.stuck_on) duty = 1;
  if (std::abs(duty) < b.dead_duty) duty = 0;  // an ideal amplifier's duty has a sign
  const double wheel = -(p.switch_drop + p.diode_drop);
  const double off_drop = p.quadrants < 3 ? -2 * p.diode_drop : 2 * p.switch_drop;
  switch (p.modulation) {
    case Modulation::kBiState: {
      const double on_from = b.stuck_on ? 0 : std::min(b.dead_time, duty * T);
      out.t1 = on_from;
      out.t2 = duty * T;
      piece(0, -1, off_drop);
      piece(1, 1, -2 * p.switch_drop);
      piece(2, -1, off_drop);
      break;
    }
    case Modulation::kTriState: {
      const double drive = 2 * duty - 1;  // > 0: on then freewheel, < 0: off then freewheel
      const double dead = drive > 0 ? std::min(b.dead_time, drive * T) : 0;
      out.t1 = dead;
      out.t2 = std::abs(drive) * T;
      piece(0, 0, wheel);
      piece(1, drive > 0 ? 1 : -1, drive > 0 ? -2 * p.switch_drop : off_drop);
      piece(2, 0, wheel);
      break;
    }
    case Modulation::kChopper: {
      out.t1 = std::min(b.dead_time, duty * T);
      out.t2 = duty * T;
      piece(0, 0, -b.freewheel_drop);
      piece(1, 1, 0);
      piece(2, 0, -b.freewheel_drop);
      // Nothing drives the coil while the switch is off: an offset cannot push current.
      out.drop[0] = out.drop[2] = -b.freewheel_drop;
      break;
    }
    case Modulation::kIdeal: {
      out.t1 = out.t2 = T;
      piece(0, duty, 0);
      piece(1, duty, 0);
      piece(2, duty, 0);
      break;
    }
  }
  out.t2 = LateEnd(out.t2, b.late_edge, out.t1, T);
  return out;
}

}  // namespace

CoilVoltage PowerBridge::Pattern(double duty, const BridgeImperfection& imperfection) const {
  return BridgeVoltage(p_, duty, imperfection);
}

CoilVoltage IdealBridgeVoltage(const AmplifierParameters& p, double duty) {
  return BridgeVoltage(p, duty, {});
}

}  // namespace ambrig
