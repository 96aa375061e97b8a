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
  if (b.stuck_on) duty = 1;
  // An ideal amplifier's duty has a sign; nothing comes out of a tri-state bridge that freewheels,
  // at a half.
  const double rest = p.modulation == Modulation::kTriState ? 0.5 : 0;
  if (std::abs(duty - rest) < b.dead_duty * (1 - rest)) duty = rest;
  const double dead_time = b.stuck_on ? 0 : b.dead_time;  // a bridge that is stuck does not switch
  const double wheel = -(p.switch_drop + p.diode_drop);
  const double off_drop = p.quadrants < 3 ? -2 * p.diode_drop : 2 * p.switch_drop;
  switch (p.modulation) {
    case Modulation::kBiState: {
      out.t1 = std::min(dead_time, duty * T);
      out.t2 = duty * T;
      piece(0, -1, off_drop);
      piece(1, 1, -2 * p.switch_drop);
      piece(2, -1, off_drop);
      break;
    }
    case Modulation::kTriState: {
      const double drive = 2 * duty - 1;  // > 0: on then freewheel, < 0: off then freewheel
      out.t1 = drive > 0 ? std::min(dead_time, drive * T) : 0;
      out.t2 = std::abs(drive) * T;
      piece(0, 0, wheel);
      piece(1, drive > 0 ? 1 : -1, drive > 0 ? -2 * p.switch_drop : off_drop);
      piece(2, 0, wheel);
      break;
    }
    case Modulation::kChopper: {
      out.t1 = std::min(dead_time, duty * T);
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

/// All switches open while the coil carries `current`.
CoilVoltage Released(const AmplifierParameters& p, const BridgeImperfection& b, double current) {
  const double against = p.quadrants > 2 && current < 0 ? 1 : -1;
  CoilVoltage out;
  out.released = true;
  const bool freewheels = p.modulation == Modulation::kChopper;
  for (int q = 0; q < 3; ++q) {
    out.gain[q] = freewheels ? 0 : against;
    out.drop[q] = freewheels ? -b.freewheel_drop : against * 2 * p.diode_drop + b.voltage_offset;
  }
  return out;
}

}  // namespace

CoilVoltage PowerBridge::Pattern(double duty, const BridgeImperfection& imperfection,
                                 double current) const {
  return imperfection.off && !imperfection.stuck_on ? Released(p_, imperfection, current)
                                                    : BridgeVoltage(p_, duty, imperfection);
}

CoilVoltage IdealBridgeVoltage(const AmplifierParameters& p, double duty) {
  return BridgeVoltage(p, duty, {});
}

}  // namespace ambrig
